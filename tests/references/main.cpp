#include <ctime>
#include <iostream>

#include "tests/references/cases.hpp"

namespace {

constexpr const char* usage =
    "usage: taut_references CASE [--refine N] [--courant C] [--until T]\n"
    "       taut_references --list\n\n"
    "Computes a table of scenes/references/ with finite elements that share no code with taut, and writes it to\n"
    "standard output; energy and CPU time go to standard error.\n\n"
    "  --refine N    multiplies the number of elements along each axis (default 1)\n"
    "  --courant C   time step over the transit time of a wave between two nodes (default 0.8)\n"
    "  --until T     ends the table at T, s, if the stored table ends later\n";

}  // namespace

int main(int count, char** words) try {
  references::Settings settings;
  std::string name;
  for (int k = 1; k < count; ++k) {
    const std::string word = words[k];
    if (word == "--refine" && k + 1 < count) {
      settings.refine = std::stoi(words[++k]);
    } else if (word == "--courant" && k + 1 < count) {
      settings.courant = std::stod(words[++k]);
    } else if (word == "--until" && k + 1 < count) {
      settings.until = std::stod(words[++k]);
    } else if (word == "--list") {
      for (const auto& [known, run] : references::cases()) std::cout << known << "\n";
      return 0;
    } else if (word == "--help" || word == "-h") {
      std::cout << usage;
      return 0;
    } else if (!name.empty() || word.starts_with("-")) {
      std::cerr << usage;
      return 2;
    } else {
      name = word;
    }
  }
  const auto found = references::cases().find(name);
  if (found == references::cases().end() || settings.refine < 1 || !(settings.courant > 0)) {
    std::cerr << usage;
    return 2;
  }
  found->second(settings, std::cout);
  std::cerr << name << ": " << static_cast<double>(std::clock()) / CLOCKS_PER_SEC << " s of CPU time\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << "taut_references: " << error.what() << "\n";
  return 1;
}
