#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

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
/// The line of a script that prints the title of the picture.
std::string plot_title(std::string_view title);
/// The same for a note in small print at its left edge; `height` is 0 at the bottom, 1 at the top.
std::string plot_note(std::string_view note, double height);

/// Colour and dashes of the k-th line of a picture: eight colours, then the same dashed.
std::string line_style(std::size_t k);
/// Its marker.
std::string marker_style(std::size_t k);

/// Writes data and script, then has gnuplot draw. Gives the exit code; throws OutputError when gnuplot is not
/// installed or fails; data and script stay.
int draw_plot(const PlotFiles& files, const std::string& script, const std::string& data);

}  // namespace taut::cli
