#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace taut::fuzz {

/// A reader, or a family of readers, of untrusted input.
struct Target {
  std::string_view name;  // also its folder in corpus/ and found/
  void (*read)(std::string_view bytes);
};

std::span<const Target> targets();

/// Runs the target on the bytes in an empty folder. Accepts taut's own errors about the input; passes on other
/// exceptions.
void feed(const Target& target, std::string_view bytes);

/// A wrong result: the fault of the reader, not of the input.
class Finding : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};
void expect(bool holds, const std::string& what);

/// Runs one of several readings of an input; its errors do not stop the others.
void attempt(const std::function<void()>& reading);

/// Splits an input of several files at lines "%%%%" into `count` parts; missing parts are empty.
std::vector<std::string> parts_of(std::string_view bytes, std::size_t count);
std::vector<std::string> lines_of(std::string_view bytes);

/// Folder of the running target, which is the current folder.
std::filesystem::path folder();
/// Writes a file into `folder()` and returns its path.
std::filesystem::path write(const std::string& name, std::string_view bytes);

/// Applies the changes encoded in the input to a valid text or state: each is a place (4 bytes), an operation (1
/// byte) and a value (8 bytes). A small input thus reaches deep into a large file of any format.
std::string changed(std::string bytes, std::string_view changes);

}  // namespace taut::fuzz
