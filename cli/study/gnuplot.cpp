#include "cli/study/gnuplot.hpp"

#include "cli/system/atomic_file.hpp"
#include "cli/system/external_program.hpp"
#include "engine/error.hpp"

namespace taut::cli {

namespace fs = std::filesystem;

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
  const bool vector = files.picture.extension() == ".svg";
  const std::string size = std::to_string(width) + "," + std::to_string(height);
  return "# gnuplot " + files.script().filename().string() + " draws this again, from " +
         files.data().filename().string() + "\n" + "data = " + plot_text(files.data().filename().string()) +
         "\n" + "if (!exists('picture')) picture = " + plot_text(files.picture.filename().string()) + "\n" +
         (vector ? "set terminal svg noenhanced size " + size + " font 'DejaVu Sans,14' background 'white'\n"
                 : "set terminal pngcairo noenhanced size " + size + " font 'DejaVu Sans,11'\n") +
         "set output picture\n";
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
