#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cli/drawing/drawing.hpp"

namespace taut::cli {

/// What a key of drawing is given or holds: a word, or numbers.
using DrawingValue = std::variant<std::string, std::vector<double>>;

/// The word for no text.
inline constexpr std::string_view nothing = "none";
/// The word for what is open.
inline constexpr std::string_view automatic = "auto";

/// Something that says how pictures look: a key of [render] in a scene file, an option of the commands that
/// draw, a command of a session. It takes one of some words, numbers, or a text that the scene has to know.
struct DrawingKey {
  struct Words {
    std::string_view kind;                          // "field"
    std::vector<std::string> (*names)() = nullptr;  // all but "auto"
    bool or_formula = false;                        // or "=" and an expression

    bool has_formula(const std::string& word) const { return or_formula && word.starts_with('='); }
  };
  struct Numbers {
    std::size_t count = 1;
    bool whole = false;
    char between = ':';             // them, where they are typed
    std::string_view in_file = {};  // "[low, high]": what may stand there beside "auto"
    std::string typed = {};         // what is right, for who typed something else
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  };

  std::string_view name;               // "range": the option is --range
  std::string_view placeholder;        // of the option; ends in "|auto" where that can be typed
  std::string_view help;               // of the option
  std::string_view session_help = {};  // of the session's command; empty: there is none
  bool may_be_open = false;            // "auto" in a scene file
  bool of_runs = false;                // how many pictures a run makes, not how each looks
  Words words = {};
  bool of_text = false;           // free; "none" for nothing
  std::string_view pattern = {};  // of a text that is not free: a regular expression; `typed` explains it
  Numbers numbers = {};
  /// What is wrong with the value, in the words of a scene file; else nothing, and the drawing has it. A word
  /// is one of the names, or "auto" where that is allowed. Whether a text and a camera go with the scene
  /// `suit` finds out (cli/scene).
  std::string (*set)(Drawing&, const DrawingValue&);
  DrawingValue (*get)(const Drawing&);

  bool takes_words() const { return words.names != nullptr; }
};

/// Every key, in the order of --help and of scene.toml.
std::span<const DrawingKey> drawing_keys();
/// One of them.
const DrawingKey& drawing_key(std::string_view name);

/// Sets a key as typed, on the command line or in a session; numbers have `between` between them. Throws
/// UsageError, and then has changed nothing.
void set_typed(Drawing& drawing, const DrawingKey& key, const std::string& text);

}  // namespace taut::cli
