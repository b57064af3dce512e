#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line/placeholders.hpp"

namespace taut::cli {

/// Lines of stdin; on a terminal with editing, completion and a saved history.
class LineInput {
 public:
  /// Completes the last word, which may be empty.
  using Complete = std::function<Choices(const std::vector<std::string>& words)>;

  explicit LineInput(Complete complete);
  ~LineInput();
  LineInput(const LineInput&) = delete;
  LineInput& operator=(const LineInput&) = delete;

  /// Whether stdin and stdout are a terminal.
  bool is_typed() const { return typed_; }
  /// Next line; nullopt at the end of input, or if a signal asks the program to end. Ctrl-C discards a partial line.
  std::optional<std::string> next();

 private:
  std::optional<std::string> next_typed();

  bool typed_;
};

}  // namespace taut::cli
