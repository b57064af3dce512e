#include "cli/session/line_input.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <editline/readline.h>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <unistd.h>

#include "cli/system/interrupts.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;

constexpr int lines_kept = 1000;

// global, since libedit calls plain functions
LineInput::Complete complete_words;
std::vector<std::string> found;

/// libedit frees the result. Returns nullptr at the end.
char* next_found(const char*, int state) {
  static std::size_t next = 0;
  if (state == 0) next = 0;
  return next < found.size() ? ::strdup(found[next++].c_str()) : nullptr;
}

/// Returns nullptr without matches: libedit then completes file names, unless `rl_attempted_completion_over`.
char** complete_last_word(const char* last, int start, int) {
  std::istringstream before(std::string(rl_line_buffer, static_cast<std::size_t>(start)));
  std::vector<std::string> words;
  for (std::string word; before >> word;) words.push_back(word);
  words.emplace_back(last);
  const Choices choices = complete_words(words);
  rl_attempted_completion_over = choices.files.empty() ? 1 : 0;
  found.clear();
  for (const std::string& word : choices.words)
    if (word.starts_with(last)) found.push_back(word);
  rl_completion_append_character = found.size() == 1 && found.front().ends_with('=') ? '\0' : ' ';
  return found.empty() ? nullptr : rl_completion_matches(last, next_found);
}

/// Path by the XDG specification, or empty.
fs::path history_file() {
  const char* const state = std::getenv("XDG_STATE_HOME");
  const char* const home = std::getenv("HOME");
  if (state && *state == '/') return fs::path(state) / "taut" / "session_history";
  if (home && *home) return fs::path(home) / ".local" / "state" / "taut" / "session_history";
  return {};
}

}  // namespace

LineInput::LineInput(Complete complete) : typed_(::isatty(STDIN_FILENO) && ::isatty(STDOUT_FILENO)) {
  if (!typed_) return;
  complete_words = std::move(complete);
  rl_readline_name = "taut";
  rl_catch_signals = 1;  // at a signal, libedit restores the terminal
  rl_basic_word_break_characters = " \t";
  rl_attempted_completion_function = complete_last_word;
  using_history();
  stifle_history(lines_kept);
  read_history(history_file().c_str());
}

LineInput::~LineInput() {
  if (!typed_) return;
  std::error_code ignored;
  const fs::path file = history_file();
  fs::create_directories(file.parent_path(), ignored);
  write_history(file.c_str());
  complete_words = nullptr;
}

std::optional<std::string> LineInput::next() {
  if (typed_) return next_typed();
  std::string line;
  return std::getline(std::cin, line) ? std::optional(line) : std::nullopt;
}

std::optional<std::string> LineInput::next_typed() {
  while (true) {
    const Interrupts interrupts;
    char* const line = ::readline("> ");
    if (line) {
      const std::string text = line;
      std::free(line);
      if (text.find_first_not_of(" \t") != std::string::npos) add_history(text.c_str());
      return text;
    }
    std::puts("");
    if (!interrupts.interrupted() || interrupts.must_end()) return std::nullopt;
  }
}

}  // namespace taut::cli
