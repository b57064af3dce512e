#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// Files of a picture. Users can change the script and run `gnuplot chart.gp`.
struct PlotFiles {
  std::filesystem::path picture;  // chart.png or chart.svg
  std::filesystem::path script() const { return with(".gp"); }
  std::filesystem::path data() const { return with(".dat"); }

 private:
  std::filesystem::path with(const char* extension) const {
    return std::filesystem::path(picture).replace_extension(extension);
  }
};

/// Throws UsageError unless the name ends in .png or .svg.
PlotFiles plot_files(const std::string& picture);

/// Quotes for a script.
std::string plot_text(std::string_view text);

std::string plot_head(const PlotFiles& files, int width, int height);
/// " pointsize SIZE", equal in all formats.
std::string point_size(std::string_view size);
std::string plot_title(std::string_view title);
/// Small note at the left; `height` from 0 (bottom) to 1.
std::string plot_note(std::string_view note, double height);
std::string titled(std::string_view title);
/// Font size in points, at most `size`, for a text in `room` pixels.
int font_that_fits(std::string_view text, double room, int size);

std::string plot_comment(std::string_view text);
/// Quotes for a data line.
std::string data_text(std::string_view text);

inline constexpr int plot_width = 1280;     // pixels
inline constexpr double axis_font = 11;     // points
inline constexpr double smallest_font = 6;  // points

/// Shortens a name, keeps both ends.
std::string shortened(const std::string& name);
/// Approximate pixels of the longest text; `size` in points.
double text_width(std::string_view text, double size);
double text_width(const std::vector<std::string>& texts, double size);
/// Right edge of a plot beside its legend, as a share of the width.
double right_margin(const std::vector<std::string>& names);

/// Writes data and script, then runs gnuplot; returns its exit code. Throws OutputError without gnuplot or if it
/// fails.
int draw_plot(const PlotFiles& files, const std::string& script, const std::string& data);

}  // namespace taut::cli
