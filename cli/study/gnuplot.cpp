#include "cli/study/gnuplot.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "cli/system/atomic_file.hpp"
#include "cli/system/external_program.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;

std::string one_line(std::string_view text) {
  std::string line(text);
  for (char& c : line)
    if (c >= 0 && c < ' ') c = ' ';
  return line;
}

/// The name of a file in the script's folder, as a string of gnuplot: a '|' or '<' in front would make it a
/// command, a '-' an option; a line break would end the line.
std::string plot_file(const fs::path& file) {
  std::string result;
  for (const char c : "./" + file.filename().string()) {
    if (c >= 0 && c < ' ')
      result += fmt::format("'.\"\\{:03o}\".'", static_cast<int>(c));
    else
      result += c == '\'' ? "''" : std::string(1, c);
  }
  return "'" + result + "'";
}

}  // namespace

PlotFiles plot_files(const std::string& picture) {
  const std::string extension = fs::path(picture).extension().string();
  if (extension != ".png" && extension != ".svg")
    throw UsageError("the picture '" + picture + "' ends neither in .png nor in .svg");
  return {picture};
}

std::string plot_text(std::string_view text) {
  std::string result = "'";
  for (const char c : one_line(text)) {
    if (c == '\'') result += c;  // two of them stand for one
    result += c;
  }
  return result + "'";
}

std::string plot_comment(std::string_view text) { return "# " + one_line(text) + "\n"; }

std::string data_text(std::string_view text) {
  std::string plain = one_line(text);
  for (char& c : plain)
    if (c == '"' || c == '\\') c = '\'';
  return "\"" + plain + "\"";
}

std::string shortened(const std::string& name) {
  constexpr std::size_t longest = 46;
  if (name.size() <= longest) return name;
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0) == 0x80) --end;  // no half letter
  return name.substr(0, end) + "…";
}

double right_margin(const std::vector<std::string>& names) {
  constexpr double letter = 8.0, sample = 78;  // pixels
  std::size_t longest = 20;                    // "open, ×: not stable"
  for (const std::string& name : names) longest = std::max(longest, name.size());
  return 1 - (sample + letter * static_cast<double>(longest)) / plot_width;
}

std::string plot_head(const PlotFiles& files, int width, int height) {
  const bool vector = files.picture.extension() == ".svg";
  return fmt::format(
      "{}"
      "data = {}\n"
      "if (!exists('picture')) picture = {}\n"
      "set terminal {} noenhanced size {},{} font {}\n"
      "set encoding utf8\n"
      "set output picture\n",
      plot_comment("gnuplot " + files.script().filename().string() + " draws this again, from " +
                   files.data().filename().string()),
      plot_file(files.data()), plot_file(files.picture), vector ? "svg" : "pngcairo", width, height,
      vector ? "'DejaVu Sans,14' background 'white'" : "'DejaVu Sans,11'");
}

std::string plot_title(std::string_view title) { return "set title " + titled(title) + "\n"; }

std::string titled(std::string_view title) {
  return plot_text(title) + fmt::format(" font ',{}'", font_that_fits(title, plot_width, 15));
}

int font_that_fits(std::string_view text, double room, int size) {
  constexpr double width = 0.56, smallest = 6;  // of a letter, of its size in points at 96 dots an inch
  const auto letters =
      static_cast<double>(std::ranges::count_if(text, [](unsigned char c) { return (c & 0xC0) != 0x80; }));
  const double fits = room / (std::max(letters, 1.0) * width * 96 / 72);
  return static_cast<int>(std::clamp(std::floor(fits), smallest, static_cast<double>(size)));
}

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
  const std::string output = "picture = " + plot_file(unfinished(picture));
  return make_file({"gnuplot", "charts and maps", "gnuplot-nox"},
                   {"-e", output, "./" + files.script().filename().string()}, picture.parent_path(), picture);
}

}  // namespace taut::cli
