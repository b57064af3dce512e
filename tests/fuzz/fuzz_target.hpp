#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace taut::fuzz {

/// Reader of untrusted input.
struct Target {
  std::string_view name;  // also of the folders in corpus/ and found/
  void (*read)(std::string_view bytes);
};

std::span<const Target> targets();

/// Runs the target in an empty folder and ignores taut's own errors.
void feed(const Target& target, std::string_view bytes);

/// A fault of the reader, not of the input.
class Finding : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};
void expect(bool holds, const std::string& what);

/// Ignores taut's own errors.
void attempt(const std::function<void()>& reading);

/// Splits at "%%%%\n" into `count` parts, possibly empty.
std::vector<std::string> parts_of(std::string_view bytes, std::size_t count);
std::vector<std::string> lines_of(std::string_view bytes);

std::filesystem::path folder();
std::filesystem::path write(const std::string& name, std::string_view bytes);

/// Applies changes (place: 4 bytes, operation: 1, value: 8) to a valid state.
std::string changed(std::string bytes, std::string_view changes);

}  // namespace taut::fuzz
