#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/core.h>

#include "cli/formats/mask.hpp"
#include "cli/system/external_program.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "taut-XXXXXX").string();
    if (!mkdtemp(name.data()))
      throw OutputError(name, "a temporary folder for the SVG file cannot be created");
    folder_ = name;
  }
  ~Scratch() {
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// A few kilobytes of filters can take hours.
constexpr std::chrono::seconds longest{10};

Mask paint(const std::filesystem::path& svg, int rows) {
  const Scratch scratch;
  const std::string side = std::to_string(greatest_mask_side);
  const Interrupts interrupts;
  const ProcessResult result =
      run_process({"rsvg-convert", "--format=png", "--keep-aspect-ratio", "--width=" + side,
                   "--height=" + std::to_string(std::min(rows, greatest_mask_side)), "--output=svg.png",
                   std::filesystem::absolute(svg).string()},
                  scratch.folder(), interrupts, longest);
  if (!result.found)
    throw UsageError(
        "an SVG file needs rsvg-convert, which is not installed: sudo apt-get install librsvg2-bin");
  if (result.late)
    throw UsageError(fmt::format(
        "{}: rsvg-convert takes more than {} s; simplify it, for instance by removing its filters",
        svg.string(), longest.count()));
  if (result.code != 0) {
    const std::string why = result.errors.substr(0, result.errors.find('\n'));
    throw UsageError(svg.string() + " is not an SVG file that rsvg-convert can paint" +
                     (why.empty() ? "" : ": " + why));
  }
  return read_mask(scratch.folder() / "svg.png", MaskOf::alpha);
}

}  // namespace

Mask paint_svg(const std::filesystem::path& svg, int rows) {
  constexpr int first_look = 512;
  const Mask small = paint(svg, first_look), part = cropped(small);
  if (part.rows == 0) throw UsageError(svg.string() + " paints nothing: it needs a path with fill or stroke");
  const double canvas = static_cast<double>(rows) * small.rows / part.rows;
  return cropped(paint(svg, static_cast<int>(std::min<double>(std::ceil(canvas), greatest_mask_side))));
}

}  // namespace taut::cli
