#include "cli/system/provenance.hpp"

#include <filesystem>
#include <unistd.h>

#include <fmt/chrono.h>

#include "cli/system/atomic_file.hpp"
#include "cli/system/build_info.hpp"
#include "cli/text/format.hpp"
#include "engine/core/machine.hpp"

namespace taut::cli {
namespace {

std::string_view instruction_set() {
  return has_x86_64_v4() ? "x86-64-v4" : has_x86_64_v3() ? "x86-64-v3" : "baseline";
}

/// In a run of a sweep, the words of `taut sweep`.
Json command_line() {
  const std::string text = read_whole("/proc/self/cmdline").value_or("");
  Json words = Json::array();
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\0', begin), text.size());
    words.add(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

Json libraries() {
  Json all = Json::object();
  for (const Library& library : build_info.libraries) all[library.name] = library.version;
  return all;
}

Json formats() {
  Json all = Json::object();
  for (const FileFormat& format : file_formats) all[format.file] = format.number;
  return all;
}

}  // namespace

std::string version_text() {
  std::vector<std::string> with_version, with_format;
  for (const Library& l : build_info.libraries)
    with_version.push_back(fmt::format("{} {}", l.name, l.version));
  for (const FileFormat& f : file_formats) with_format.push_back(fmt::format("{} {}", f.file, f.number));
  return fmt::format(
      "taut {} ({})\n\ncompiler         {}\ninstruction set  {}\nlibraries        {}\nfile formats     {}\n",
      build_info.version, build_info.commit, build_info.compiler, instruction_set(), join(with_version),
      join(with_format));
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

Json Provenance::to_json() const {
  std::error_code error;
  return {{"commit", build_info.commit},
          {"compiler", build_info.compiler},
          {"instruction_set", instruction_set()},
          {"libraries", libraries()},
          {"formats", formats()},
          {"command", command_line()},
          {"working_folder", std::filesystem::current_path(error).string()},
          {"host", host_name()},
          {"start", fmt::format("{:%FT%TZ}", fmt::gmtime(start_))},
          {"wall_seconds", wall_.seconds()},
          {"cpu_seconds", cpu_.seconds()},
          {"other_load", load_.of_others()}};
}

}  // namespace taut::cli
