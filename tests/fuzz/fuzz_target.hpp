#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace taut::fuzz {

/// A reader, or a family of readers, of what somebody else has written.
struct Target {
  std::string_view name;  // of its folder in corpus/ and found/
  void (*read)(std::string_view bytes);
};

/// All of them.
std::span<const Target> targets();

/// Has the target read the bytes, in an empty folder of its own. An error of taut's own, which names what is
/// wrong with the input, is how it should be; whatever else is thrown goes on to the caller.
void feed(const Target& target, std::string_view bytes);

/// What came out is not what should have: no input is to blame.
class Finding : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};
void expect(bool holds, const std::string& what);

/// Does one of several readings of an input, so that its error does not keep the others from theirs.
void attempt(const std::function<void()>& reading);

/// The parts of an input of several files, between lines "%%%%"; as many as asked for, some empty.
std::vector<std::string> parts_of(std::string_view bytes, std::size_t count);
std::vector<std::string> lines_of(std::string_view bytes);

/// The folder of the target at work, which is the current one.
std::filesystem::path folder();
/// Writes a file there and gives its path.
std::filesystem::path write(const std::string& name, std::string_view bytes);

/// A valid text or state of bytes in which the input changes something: a change is a place (4 bytes), what
/// is done (1 byte) and a value (8 bytes). So a small input reaches deep into a large file, whatever its
/// format is by now.
std::string changed(std::string bytes, std::string_view changes);

}  // namespace taut::fuzz
