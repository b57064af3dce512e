#pragma once

#include <span>
#include <string>
#include <vector>

#include "cli/command_line/command.hpp"

namespace taut::cli {

/// What may come at the end of a command line.
struct Completion {
  struct Word {
    std::string text;  // the whole word; one that ends in '=' goes on
    std::string help;
  };
  std::vector<Word> words;
  std::string files;  // as in Choices
};

/// How `typed`, the words behind `taut`, can go on with these commands: what the last of them, which may be
/// empty, is the beginning of. Made from the tables that --help, `list` and `describe` are made from. Words
/// that make no sense are no error: nothing is found then.
Completion complete(std::span<const Command> commands, const std::vector<std::string>& typed);

/// The same for the script of a shell, which asks with `taut --complete WORDS`: a line with the pattern of
/// files, then a line for each word: the text, a tab, the help.
std::string answer_to_shell(std::span<const Command> commands, const std::vector<std::string>& typed);

}  // namespace taut::cli
