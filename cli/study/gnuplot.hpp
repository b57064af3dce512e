#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

struct PlotFiles {
  std::filesystem::path picture;
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
inline constexpr double axis_font = 11;     // points
inline constexpr double smallest_font = 6;  // points

std::string plot_text(std::string_view text);

/// `width`, `height`: pixels; `scale` enlarges everything.
std::string plot_head(const PlotFiles& files, int width, int height, double scale = 1);
/// " pointsize SIZE*points", which looks equal in all formats.
std::string point_size(std::string_view size);
std::string plot_title(std::string_view title);
/// Note at the left edge; `height`: 0 at the bottom, 1 at the top.
std::string plot_note(std::string_view note, double height);
/// Quoted; long titles have a smaller font. `room`: pixels.
std::string titled(std::string_view title, double room = plot_width);
/// Points, at most `size`; `room` in pixels.
int font_that_fits(std::string_view text, double room, int size);

std::string plot_comment(std::string_view text);
std::string data_text(std::string_view text);

/// Keeps both ends.
std::string shortened(const std::string& name);
/// Approximate, in pixels; `size` in points.
double text_width(std::string_view text, double size);
double text_width(const std::vector<std::string>& texts, double size);
/// Pixels, with line samples.
double legend_width(const std::vector<std::string>& names);
/// Right edge of the plot, as a share of the width.
double right_margin(const std::vector<std::string>& names);

/// Writes data and script, then runs gnuplot. Returns exit_fine or the code of an interrupt. Throws OutputError if
/// gnuplot is missing or fails.
int draw_plot(const PlotFiles& files, const std::string& script, const std::string& data);

}  // namespace taut::cli
