#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

/// Files of a gnuplot picture, in one folder. After changes to the script, `gnuplot chart.gp` redraws it.
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

/// Quotes a text for a script.
std::string plot_text(std::string_view text);

/// Head of a script; sizes in pixels.
std::string plot_head(const PlotFiles& files, int width, int height);
/// " pointsize SIZE", equal in all formats.
std::string point_size(std::string_view size);
std::string plot_title(std::string_view title);
/// Small note at the left edge; `height` from 0 (bottom) to 1 (top).
std::string plot_note(std::string_view note, double height);
/// A title with a font that fits.
std::string titled(std::string_view title);
/// Font size in points, at most `size`, for a text in `room` pixels.
int font_that_fits(std::string_view text, double room, int size);

std::string plot_comment(std::string_view text);
/// Quotes a text for a data line.
std::string data_text(std::string_view text);

inline constexpr int plot_width = 1280;     // pixels
inline constexpr double axis_font = 11;     // points, default
inline constexpr double smallest_font = 6;  // points

/// Shortens a name, keeping both ends.
std::string shortened(const std::string& name);
/// Approximate width of the longest text, pixels; `size` in points.
double text_width(std::string_view text, double size);
double text_width(const std::vector<std::string>& texts, double size);
/// Right edge of a picture beside its legend, as a share of the width.
double right_margin(const std::vector<std::string>& names);

/// Writes data and script, and runs gnuplot; returns its exit code. Throws OutputError if gnuplot is missing or
/// fails; data and script remain.
int draw_plot(const PlotFiles& files, const std::string& script, const std::string& data);

}  // namespace taut::cli
