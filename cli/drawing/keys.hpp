#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cli/drawing/drawing.hpp"

namespace taut::cli {

using DrawingValue = std::variant<std::string, std::vector<double>>;
using DrawingValues = std::map<std::string, DrawingValue, std::less<>>;  // by key

/// Word for no text.
inline constexpr std::string_view nothing = "none";
/// Word for an open value.
inline constexpr std::string_view automatic = "auto";

/// A key of [render], an option of drawing commands and a session command. Its value is a word, numbers, or a text.
struct DrawingKey {
  struct Words {
    std::string_view kind;
    std::vector<std::string> (*names)() = nullptr;  // all but "auto"
    bool or_formula = false;                        // also "=EXPRESSION"
    bool is_list = false;                           // several, with commas between

    bool has_formula(const std::string& word) const { return or_formula && word.starts_with('='); }
    /// First part of `text` that is no name, or nullopt.
    std::optional<std::string> first_unknown(const std::string& text) const;
  };
  struct Numbers {
    std::size_t count = 1;
    bool whole = false;
    char between = ':';             // separator of typed numbers
    std::string_view in_file = {};  // "[low, high]": allowed beside "auto"
    std::string typed = {};         // expected form, for messages
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  };

  std::string_view name;         // "font_size" for --font-size
  std::string_view placeholder;  // ends in "|auto" if allowed
  std::string_view help;
  std::string_view session_help = {};  // empty: no session command
  bool allows_auto = false;            // "auto" allowed in scene files
  bool counts_frames = false;          // number of pictures, not style
  Words words = {};
  bool is_free_text = false;      // free text; "none" if empty
  std::string_view pattern = {};  // of other texts; `typed` explains it
  Numbers numbers = {};
  /// Sets the value, or returns an error for scene files. `apply_scene` (cli/scene) checks if it fits the scene.
  std::string (*set)(Drawing&, const DrawingValue&);
  DrawingValue (*get)(const Drawing&);

  bool takes_words() const { return words.names != nullptr; }
  /// "--font-size".
  std::string option() const;
};

/// All keys, in the order of --help and scene.toml.
std::span<const DrawingKey> drawing_keys();
const DrawingKey& drawing_key(std::string_view name);

/// Sets a key as typed on the command line or in a session. Throws UsageError and then changes nothing.
void set_typed(Drawing& drawing, const DrawingKey& key, const std::string& text);

}  // namespace taut::cli
