#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sys/resource.h>

#include <doctest/doctest.h>

#include "cli/system/child_process.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace taut::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Limits memory; ctest limits the time.
void limit_memory() {
  constexpr rlim_t most = rlim_t{1} << 30;
  const rlimit limit{most, most};
  ::setrlimit(RLIMIT_DATA, &limit);
}

/// Prints each name before reading, so that the last name is the file that crashed.
int feed_all(const Target& target, const std::vector<fs::path>& files) {
  limit_memory();
  int failures = 0;
  for (const fs::path& file : files) {
    std::cout << file.string() << std::endl;
    try {
      feed(target, bytes_of(file));
    } catch (const std::exception& error) {
      std::cout << "  " << error.what() << std::endl;
      ++failures;
    }
  }
  return failures > 0;
}

}  // namespace

TEST_SUITE("fuzz") {
  TEST_CASE("every stored finding and every input of the corpus is read or refused") {
    const fs::path here = fs::path(TAUT_SOURCE_DIR) / "tests/fuzz";
    for (const Target& target : targets()) {
      std::vector<fs::path> files = files_in(here / "found" / target.name);
      for (const fs::path& file : files_in(here / "corpus" / target.name)) files.push_back(file);
      cli::ChildProcess child([&] { return feed_all(target, files); });
      while (child.read_output()) continue;
      const cli::ChildProcess::End end = child.wait();
      CHECK_MESSAGE((end.code == 0 && end.signal == 0), "signal ", end.signal, "; files and errors:\n",
                    end.output);
    }
  }

  TEST_CASE("every folder of inputs has a target") {
    const fs::path here = fs::path(TAUT_SOURCE_DIR) / "tests/fuzz";
    for (const char* kind : {"found", "corpus"})
      for (const fs::path& folder : files_in(here / kind))
        CHECK_MESSAGE(std::ranges::count(targets(), folder.filename().string(), &Target::name) == 1,
                      folder.string());
  }
}

}  // namespace taut::fuzz
