#include "cli/system/made_file.hpp"

#include <sstream>

#include "cli/system/exit_code.hpp"
#include "cli/system/external_program.hpp"
#include "cli/text/format.hpp"
#include "engine/error.hpp"

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

/// The last lines of `text`, indented.
std::string last_lines(const std::string& text) {
  constexpr int shown = 5;
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (!line.empty()) lines.push_back("  " + line);
  if (lines.size() > shown) lines.erase(lines.begin(), lines.end() - shown);
  return join(lines, "\n");
}

}  // namespace

fs::path unfinished(const fs::path& file) {
  fs::path part = file;
  return part.replace_extension(".part" + file.extension().string());
}

int make_file(const Maker& maker, const std::vector<std::string>& arguments, const fs::path& folder,
              const fs::path& file) {
  const fs::path part = unfinished(file);
  std::vector<std::string> words{maker.name};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const Interrupts interrupts;
  const ProcessResult result = run_process(words, folder, interrupts);
  std::error_code error;
  const bool good = result.found && !result.stopped && result.code == 0;
  if (good) fs::rename(part, file, error);
  if (good && !error) return exit_fine;
  std::error_code ignored;
  fs::remove(part, ignored);
  if (!result.found)
    throw OutputError(file.string(), maker.name + " is needed for " + maker.purpose +
                                         " and is not installed (apt-get install " + maker.package + ")");
  if (result.stopped) return exit_interrupted;
  throw OutputError(file.string(), error
                                       ? "cannot be written: " + error.message()
                                       : maker.name + " failed with exit code " +
                                             std::to_string(result.code) + "\n" + last_lines(result.errors));
}

}  // namespace taut::cli
