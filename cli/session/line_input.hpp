#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line/placeholders.hpp"

namespace taut::cli {

/// The lines of stdin: typed on a terminal, with editing, completion and a history that the next session has
/// too; else as they come.
class LineInput {
 public:
  /// What the last of these words, which may be empty, can become.
  using Complete = std::function<Choices(const std::vector<std::string>& words)>;

  explicit LineInput(Complete complete);
  ~LineInput();
  LineInput(const LineInput&) = delete;
  LineInput& operator=(const LineInput&) = delete;

  /// stdin and stdout are a terminal.
  bool is_typed() const { return typed_; }
  /// The next line; none at the end, or when the program is asked to end. Ctrl-C while a line is being typed
  /// gives that line up.
  std::optional<std::string> next();

 private:
  std::optional<std::string> next_typed();

  bool typed_;
};

}  // namespace taut::cli
