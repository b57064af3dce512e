#include "cli/study/gnuplot.hpp"

#include <array>

#include <fmt/format.h>

#include "cli/system/atomic_file.hpp"
#include "cli/system/external_program.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;

// Okabe and Ito's colours, which colour-blind readers tell apart too, with darker ones for their yellow and
// black
constexpr std::array colors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                               "#56B4E9", "#E69F00", "#6A3D9A", "#444444"};
// with eight colours no two of 56 lines look alike
constexpr std::array markers = {7, 5, 9, 13, 11, 15, 4};  // of gnuplot: filled disc, square, ...
constexpr std::array dashes = {1, 2, 4};                  // solid, dashed, dotted and dashed

}  // namespace

PlotFiles plot_files(const std::string& picture) {
  const std::string extension = fs::path(picture).extension().string();
  if (extension != ".png" && extension != ".svg")
    throw UsageError("the picture '" + picture + "' ends neither in .png nor in .svg");
  return {picture};
}

std::string plot_text(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += c;  // two of them stand for one
    result += c >= 0 && c < ' ' ? ' ' : c;
  }
  return result + "'";
}

std::string plot_head(const PlotFiles& files, int width, int height) {
  const std::string script = files.script().filename().string(), data = files.data().filename().string();
  const bool vector = files.picture.extension() == ".svg";
  return fmt::format(
      "# gnuplot {} draws this again, from {}\n"
      "data = {}\n"
      "if (!exists('picture')) picture = {}\n"
      "set terminal {} noenhanced size {},{} font {}\n"
      "set output picture\n",
      script, data, plot_text(data), plot_text(files.picture.filename().string()),
      vector ? "svg" : "pngcairo", width, height,
      vector ? "'DejaVu Sans,14' background 'white'" : "'DejaVu Sans,11'");
}

std::string line_style(std::size_t k) {
  const int dash = dashes[k / colors.size() % dashes.size()];
  return std::string("linecolor '") + colors[k % colors.size()] + "' dashtype " + std::to_string(dash);
}

std::string marker_style(std::size_t k) {
  return "pointtype " + std::to_string(markers[k % markers.size()]) + " pointsize 1.4";
}

std::string plot_title(std::string_view title) { return "set title " + plot_text(title) + " font ',15'\n"; }

std::string plot_note(std::string_view note, double height) {
  return fmt::format("set label {} at screen 0.015, screen {} font ',9' textcolor '#555555'\n",
                     plot_text(note), height);
}

int draw_plot(const PlotFiles& files, const std::string& script, const std::string& data) {
  const fs::path picture = fs::absolute(files.picture);
  std::error_code error;
  fs::create_directories(picture.parent_path(), error);
  write_atomically(files.data(), data);
  write_atomically(files.script(), script);
  const std::string output = "picture = " + plot_text(unfinished(picture).filename().string());
  return make_file({"gnuplot", "charts and maps", "gnuplot-nox"},
                   {"-e", output, files.script().filename().string()}, picture.parent_path(), picture);
}

}  // namespace taut::cli
