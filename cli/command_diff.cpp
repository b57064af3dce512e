#include <cmath>
#include <optional>
#include <ostream>

#include <CLI/CLI.hpp>

#include "cli/command.hpp"
#include "cli/exit_code.hpp"
#include "cli/option_checks.hpp"
#include "cli/text.hpp"
#include "render/image_difference.hpp"

namespace taut {
namespace {

struct Options {
  std::string a, b;
  std::optional<double> max_difference;
  std::optional<std::string> out;
};

int diff(const Options& options, std::ostream& out) {
  const Image a = read_png(options.a);
  const Image b = read_png(options.b);
  const ImageDifference d = compare(a, b);
  const bool same = options.max_difference ? d.greatest <= *options.max_difference : alike(d);
  if (options.out) write_png(difference_picture(a, b), *options.out);
  out << (same ? "alike" : "different") << '\n'
      << in_columns({{"pixels that differ visibly", percent(d.share)},
                     {"greatest difference",
                      brief(d.greatest) + " of 100 (ΔE*ab; an eye notices " + brief(just_noticeable) + ")"},
                     {"densest window", percent(d.densest) + " of " + std::to_string(d.width) + "x" +
                                            std::to_string(d.height) + " pixels at " +
                                            std::to_string(d.column) + "," + std::to_string(d.row)}});
  return same ? exit_fine : exit_different;
}

}  // namespace

std::function<int(Streams)> declare_diff(CLI::App& app) {
  auto options = std::make_shared<Options>();
  app.add_option("A", options->a, "an image (PNG)")->option_text(" ")->required();
  app.add_option("B", options->b, "another of the same size")->option_text(" ")->required();
  app.add_option(
         "--max-difference", options->max_difference,
         "alike when no pixel differs by more (ΔE*ab, black to white is 100; 0: every pixel is the same); "
         "default: alike when hardly a pixel differs visibly and nowhere many together")
      ->option_text("X")
      ->check(not_negative_number);
  app.add_option("--out", options->out, "draw where they differ")->option_text("diff.png");
  return [options](Streams streams) { return diff(*options, streams.out); };
}

}  // namespace taut
