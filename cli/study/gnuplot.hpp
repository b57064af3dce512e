#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// Files of a picture. Users can change the script and run `gnuplot chart.gp`.
struct PlotFiles {
  std::filesystem::path picture;  // chart.png, chart.svg or chart.pdf
  std::filesystem::path script() const { return with(".gp"); }
  std::filesystem::path data() const { return with(".dat"); }

 private:
  std::filesystem::path with(const char* extension) const {
    return std::filesystem::path(picture).replace_extension(extension);
  }
};

/// Throws UsageError unless the name ends in .png, .svg or .pdf.
PlotFiles plot_files(const std::string& picture);

inline constexpr int plot_width = 1280;     // pixels
inline constexpr double axis_font = 11;     // default font, points
inline constexpr double smallest_font = 6;  // points

/// Quotes a text for a script.
std::string plot_text(std::string_view text);

/// Start of a script: a picture of `width` × `height` pixels in the format of its name. `scale` enlarges everything:
/// texts, lines and the picture itself.
std::string plot_head(const PlotFiles& files, int width, int height, double scale = 1);
/// " pointsize SIZE", equal in all formats.
std::string point_size(std::string_view size);
std::string plot_title(std::string_view title);
/// Script line for a small note at the left edge; `height` is 0 at the bottom, 1 at the top.
std::string plot_note(std::string_view note, double height);
/// Quoted title with its font, which is smaller for long titles; `room` in pixels.
std::string titled(std::string_view title, double room = plot_width);
/// Font size, points, at most `size`, such that the text is at most `room` pixels long.
int font_that_fits(std::string_view text, double room, int size);

std::string plot_comment(std::string_view text);
/// Quotes a text for a line of data.
std::string data_text(std::string_view text);

/// Shortens a name for a legend. Both ends stay, since they distinguish names.
std::string shortened(const std::string& name);
/// Approximate length of a text, or of the longest text, in pixels, at a font size in points.
double text_width(std::string_view text, double size);
double text_width(const std::vector<std::string>& texts, double size);
/// Width of a legend with line samples, pixels.
double legend_width(const std::vector<std::string>& names);
/// Right edge of a plot beside its legend, as a share of the width.
double right_margin(const std::vector<std::string>& names);

/// Writes data and script, then runs gnuplot. Returns the exit code. Throws OutputError if gnuplot is missing or
/// fails; data and script remain.
int draw_plot(const PlotFiles& files, const std::string& script, const std::string& data);

}  // namespace taut::cli
