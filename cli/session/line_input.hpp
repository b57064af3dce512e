#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line/placeholders.hpp"

namespace taut::cli {

/// Lines of stdin; a terminal has editing, completion and a history.
class LineInput {
 public:
  using Complete = std::function<Choices(const std::vector<std::string>& words)>;

  explicit LineInput(Complete complete);
  ~LineInput();
  LineInput(const LineInput&) = delete;
  LineInput& operator=(const LineInput&) = delete;

  bool is_typed() const { return typed_; }
  /// Nullopt at the end of input; on a terminal, also after SIGTERM or SIGHUP. Ctrl-C discards a partial line.
  std::optional<std::string> next();

 private:
  std::optional<std::string> next_typed();

  bool typed_;
};

}  // namespace taut::cli
