#include <filesystem>
#include <ostream>

#include "cli/arguments/options.hpp"
#include "cli/command_line/command.hpp"
#include "cli/command_line/report_options.hpp"
#include "cli/run/frame_folders.hpp"
#include "cli/system/atomic_file.hpp"
#include "cli/system/exit_code.hpp"
#include "cli/text/checks.hpp"
#include "engine/error.hpp"
#include "render/image/png.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

struct DiffArguments : DifferenceOptions, ReportOptions {
  std::string a, b;
  std::optional<std::string> out;
};

void write_difference(const render::Image& picture, const fs::path& file) {
  make_folder_of(file);
  render::write_png(picture, file);
}

int answer(const DiffArguments& options, const FolderDifference& difference, const std::string& text,
           Streams streams) {
  Json json = json_answer("diff");
  json["a"] = options.a;
  json["b"] = options.b;
  json["passed"] = difference.alike();
  json["pictures"] = pictures_json(difference);
  streams.out << (options.json ? json.dump(2) + "\n" : text);
  options.publish({"diff", options.a, test_cases(difference, options.a, options.b)}, streams.err);
  return difference.alike() ? exit_fine : exit_different;
}

int diff_images(const DiffArguments& options, Streams streams) {
  const render::Image a = render::read_png(options.a);
  const render::Image b = render::read_png(options.b);
  const render::DifferenceLimit limit = limit_of(options);
  const render::ImageDifference difference = compare(a, b);
  if (options.out) write_difference(render::difference_picture(a, b), *options.out);
  FolderDifference all;
  all.pictures = {{fs::path(options.a).filename().string(), difference, alike(difference, limit)}};
  return answer(options, all, difference_report(difference, limit), streams);
}

fs::path folder_with_pictures(const std::string& given) {
  const fs::path frames = frames_of(given);
  if (picture_names(frames).empty())
    throw UsageError("there are no pictures (PNG) in " + frames.string() +
                     "; name a folder of frames or a run folder");
  return frames;
}

int diff_folders(const DiffArguments& options, Streams streams) {
  const fs::path a = folder_with_pictures(options.a);
  const fs::path b = folder_with_pictures(options.b);
  const FolderDifference difference = compare_folders(a, b, limit_of(options));
  if (options.out && !difference.pictures.empty())
    write_difference(render::difference_picture(render::read_png(a / difference.worst),
                                                render::read_png(b / difference.worst)),
                     *options.out);
  return answer(options, difference, difference_report(difference, a.string(), b.string()), streams);
}

int diff(const DiffArguments& options, Streams streams) {
  for (const std::string& name : {options.a, options.b})
    if (!fs::exists(name)) throw UsageError("there is no image or folder '" + name + "'");
  const bool folder_a = fs::is_directory(options.a);
  if (folder_a != fs::is_directory(options.b))
    throw UsageError("'" + (folder_a ? options.a : options.b) + "' is a folder and '" +
                     (folder_a ? options.b : options.a) + "' is not; give two images or two folders");
  return folder_a ? diff_folders(options, streams) : diff_images(options, streams);
}

}  // namespace

std::function<int(Streams)> declare_diff(Options& command) {
  auto options = std::make_shared<DiffArguments>();
  command.add_argument("A", options->a, "first image (PNG), folder of images, or run folder").required();
  command
      .add_argument(
          "B", options->b,
          "second image or folder; in folders, images of the same name are compared and must have the same size")
      .required();
  declare_difference_options(command, *options);
  command
      .add("--out", "diff.png", options->out,
           "picture of the differences to write; for folders, of the pair that differs most")
      .check(png_name);
  options->declare_json(command);
  return [options](Streams streams) { return diff(*options, streams); };
}

}  // namespace taut::cli
