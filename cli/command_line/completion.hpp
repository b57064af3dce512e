#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/command_line/command.hpp"

namespace taut::cli {

struct Completion {
  struct Word {
    std::string text;  // whole word; ends with '=' if a value must follow
    std::string help;
  };
  std::vector<Word> words;
  std::string files;  // see Choices
};

/// Completes the last word of `typed`, which excludes `taut`.
Completion complete(std::span<const Command> commands, const std::vector<std::string>& typed);

/// Pattern of files, then a line per word with text, tab and help.
std::string answer_to_shell(std::span<const Command> commands, const std::vector<std::string>& typed);

}  // namespace taut::cli
