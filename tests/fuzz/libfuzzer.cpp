// libFuzzer's side of the targets: the variable TAUT_FUZZ_TARGET names the one that is fuzzed.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>

#include "tests/fuzz/fuzz_target.hpp"

namespace {

const taut::fuzz::Target& chosen() {
  const char* const name = std::getenv("TAUT_FUZZ_TARGET");
  const auto all = taut::fuzz::targets();
  const auto found = std::ranges::find(all, std::string_view(name ? name : ""), &taut::fuzz::Target::name);
  if (found != all.end()) return *found;
  std::cerr << "TAUT_FUZZ_TARGET must be one of:";
  for (const taut::fuzz::Target& target : all) std::cerr << ' ' << target.name;
  std::cerr << '\n';
  std::exit(2);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const taut::fuzz::Target& target = chosen();
  taut::fuzz::feed(target, {reinterpret_cast<const char*>(bytes), size});
  return 0;
}
