#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// The three files of a picture that gnuplot draws, beside each other: a person may change the script and run
/// `gnuplot chart.gp` in their folder.
struct PlotFiles {
  std::filesystem::path picture;  // chart.png or chart.svg
  std::filesystem::path script() const { return with(".gp"); }
  std::filesystem::path data() const { return with(".dat"); }

 private:
  std::filesystem::path with(const char* extension) const {
    return std::filesystem::path(picture).replace_extension(extension);
  }
};

/// Throws UsageError for a name that ends neither in .png nor in .svg.
PlotFiles plot_files(const std::string& picture);

/// A text in a script: in single quotes, in which nothing has a meaning.
std::string plot_text(std::string_view text);

/// The start of a script: a picture of `width` × `height` pixels in the format of its name.
std::string plot_head(const PlotFiles& files, int width, int height);
/// " pointsize SIZE", as large in each of the formats.
std::string point_size(std::string_view size);
/// The line of a script that prints the title of the picture.
std::string plot_title(std::string_view title);
/// The same for a note in small print at its left edge; `height` is 0 at the bottom, 1 at the top.
std::string plot_note(std::string_view note, double height);
/// A title and its font, smaller where it is long.
std::string titled(std::string_view title);
/// The size of a font, in points and `size` at the most, in which a text is `room` pixels long or less.
int font_that_fits(std::string_view text, double room, int size);

/// A comment line of data or of a script.
std::string plot_comment(std::string_view text);
/// A text in a line of data: in double quotes, in which nothing has a meaning.
std::string data_text(std::string_view text);

inline constexpr int plot_width = 1280;     // pixels
inline constexpr double axis_font = 11;     // points: of what has no size of its own
inline constexpr double smallest_font = 6;  // points

/// A name as a legend has room for it: what tells it from others is at its ends.
std::string shortened(const std::string& name);
/// About how long a text is, or the longest of some, in pixels, at a size in points.
double text_width(std::string_view text, double size);
double text_width(const std::vector<std::string>& texts, double size);
/// Where a picture ends and its legend of these names begins, as a share of the width.
double right_margin(const std::vector<std::string>& names);

/// Writes data and script, then has gnuplot draw. Gives the exit code; throws OutputError when gnuplot is not
/// installed or fails; data and script stay.
int draw_plot(const PlotFiles& files, const std::string& script, const std::string& data);

}  // namespace taut::cli
