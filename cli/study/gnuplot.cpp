#include "cli/study/gnuplot.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "cli/study/letters.hpp"
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

/// False for UTF-8 continuation bytes.
bool begins_letter(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

/// Octal escape that splits a single-quoted string in two: gnuplot 5.4 reads '' as a quote only after a letter.
std::string plot_byte(char c) { return fmt::format("'.\"\\{:03o}\".'", static_cast<unsigned char>(c)); }

/// gnuplot would interpret a leading '|', '<' or '-', hence "./".
std::string plot_path(const std::string& name) {
  const bool drawable = with_letters_of_fonts(name) == name;
  std::string result;
  for (const char c : "./" + name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= ' ' && c != '\'' && (byte < 0x80 || drawable);
    result += plain ? std::string(1, c) : plot_byte(c);
  }
  return fmt::format("'{}'", result);
}

std::string plot_file(const fs::path& file) { return plot_path(file.filename().string()); }

}  // namespace

PlotFiles plot_files(const std::string& picture) {
  const std::string extension = fs::path(picture).extension().string();
  if (extension != ".png" && extension != ".svg" && extension != ".pdf")
    throw UsageError(fmt::format("the picture is '{}'; it must end in .png, .svg or .pdf", picture));
  return {picture};
}

std::string plot_text(std::string_view text) {
  std::string result = "'";
  for (const char c : one_line(text)) result += c == '\'' ? plot_byte(c) : std::string(1, c);
  return result + "'";
}

std::string plot_comment(std::string_view text) { return fmt::format("# {}\n", one_line(text)); }

std::string data_text(std::string_view text) {
  std::string plain = one_line(text);
  for (char& c : plain)
    if (c == '"' || c == '\\') c = '\'';
  return fmt::format(R"("{}")", plain);
}

std::string shortened(const std::string& name) {
  constexpr std::size_t longest = 46, head = 18;
  std::vector<std::size_t> begins;
  for (std::size_t k = 0; k < name.size(); ++k)
    if (begins_letter(name[k])) begins.push_back(k);
  if (begins.size() <= longest) return name;
  return name.substr(0, begins[head]) + "…" + name.substr(begins[begins.size() - (longest - head - 1)]);
}

double text_width(std::string_view text, double size) {
  constexpr double letter = 0.62;  // average width in DejaVu Sans, plus a margin
  return static_cast<double>(std::ranges::count_if(text, begins_letter)) * letter * size * 96 / 72;
}

double text_width(const std::vector<std::string>& texts, double size) {
  double widest = 0;
  for (const std::string& text : texts) widest = std::max(widest, text_width(text, size));
  return widest;
}

double legend_width(const std::vector<std::string>& names) {
  constexpr double letter = 8.0, sample = 78;  // pixels
  std::size_t longest = 0;
  for (const std::string& name : names)
    longest = std::max(longest, static_cast<std::size_t>(std::ranges::count_if(name, begins_letter)));
  return sample + letter * static_cast<double>(longest);
}

double right_margin(const std::vector<std::string>& names) {
  const std::vector<std::string> least{"open, ×: not stable "};
  return 1 - std::max(legend_width(names), legend_width(least)) / plot_width;
}

std::string plot_head(const PlotFiles& files, int width, int height, double scale) {
  const std::string format = files.picture.extension().string();
  const double w = width * scale, h = height * scale;
  // picture size: PDF in inches, else pixels; font size: SVG in pixels, else points
  const std::string lines = fmt::format(" linewidth {0:.4g} pointscale {0:.4g}", scale);
  std::string terminal;
  if (format == ".svg")
    terminal = fmt::format(
        "svg noenhanced size {:.0f},{:.0f} font 'DejaVu Sans,11' fontscale {:.5g}{} background 'white'", w, h,
        1.3333 * scale, scale == 1 ? "" : fmt::format(" linewidth {:.4g}", scale));
  else if (format == ".pdf")
    terminal =
        fmt::format("pdfcairo noenhanced size {:.5g}in,{:.5g}in font 'DejaVu Sans,11' fontscale {:.4g}{}",
                    w / 96, h / 96, scale, lines);
  else
    terminal = fmt::format("pngcairo noenhanced size {:.0f},{:.0f} font 'DejaVu Sans,11'{}", w, h,
                           scale == 1 ? "" : fmt::format(" fontscale {:.4g}{}", scale, lines));
  return fmt::format(
      "{}data = {}\n"
      "points = {:.4g}\n"
      "if (!exists('picture')) picture = {}\n"
      "set terminal {}\n"
      "set encoding utf8\n"
      "set output picture\n",
      plot_comment(fmt::format("gnuplot {} draws this again, from {}", files.script().filename().string(),
                               files.data().filename().string())),
      plot_file(files.data()), format == ".svg" ? 0.75 * scale : 1.0, plot_file(files.picture), terminal);
}

std::string point_size(std::string_view size) { return fmt::format(" pointsize {}*points", size); }

std::string plot_title(std::string_view title) { return fmt::format("set title {}\n", titled(title)); }

std::string titled(std::string_view title, double room) {
  return fmt::format("{} font ',{}'", plot_text(title), font_that_fits(title, room, 15));
}

int font_that_fits(std::string_view text, double room, int size) {
  constexpr double width = 0.56;  // of a letter, in em
  const auto letters = static_cast<double>(std::ranges::count_if(text, begins_letter));
  const double fits = room / (std::max(letters, 1.0) * width * 96 / 72);
  return static_cast<int>(std::clamp(std::floor(fits), smallest_font, static_cast<double>(size)));
}

std::string plot_note(std::string_view note, double height) {
  return fmt::format("set label {} at screen 0.015, screen {} font ',9' textcolor '#555555'\n",
                     plot_text(note), height);
}

int draw_plot(const PlotFiles& files, const std::string& script, const std::string& data) {
  const fs::path picture = fs::absolute(files.picture);
  make_folder_of(files.picture);
  const bool vector = picture.extension() == ".svg";  // drawn with the viewer's fonts
  write_atomically(files.data(), vector ? data : with_letters_of_fonts(data));
  write_atomically(files.script(), vector ? script : with_letters_of_fonts(script));
  const fs::path folder = picture.parent_path();
  const auto arguments = [&](const fs::path& part) -> std::vector<std::string> {
    return {"-e", "picture = " + plot_path(part.lexically_relative(folder).string()),
            "./" + files.script().filename().string()};
  };
  return make_file({"gnuplot", "charts and maps", "gnuplot-nox"}, arguments, folder, picture);
}

}  // namespace taut::cli
