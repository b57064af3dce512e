// The environment variable TAUT_FUZZ_TARGET names the target.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <string>

#include "tests/fuzz/fuzz_target.hpp"

namespace {

const taut::fuzz::Target* target = nullptr;

const taut::fuzz::Target* find_target(std::string_view name) {
  const auto all = taut::fuzz::targets();
  const auto found = std::ranges::find(all, name, &taut::fuzz::Target::name);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  const char* const name = std::getenv("TAUT_FUZZ_TARGET");
  target = find_target(name ? name : "");
  if (target) return 0;
  std::cerr << "TAUT_FUZZ_TARGET must be one of:";
  for (const taut::fuzz::Target& known : taut::fuzz::targets()) std::cerr << ' ' << known.name;
  std::cerr << std::endl;
  std::_Exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  // limits the CPU time; libFuzzer limits the wall-clock time
  constexpr double most = 10;
  const std::clock_t begin = std::clock();
  taut::fuzz::feed(*target, {reinterpret_cast<const char*>(bytes), size});
  const double took = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  taut::fuzz::expect(took < most,
                     "an input takes " + std::to_string(took) + " s of CPU time; the limit is 10 s");
  return 0;
}
