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

  bool is_typed() const { return typed_; }
  /// None at the end or when asked to terminate. Ctrl-C discards a partial line.
  std::optional<std::string> next();

 private:
  std::optional<std::string> next_typed();

  bool typed_;
};

}  // namespace taut::cli
