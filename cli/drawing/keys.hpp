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

inline constexpr std::string_view nothing = "none";
inline constexpr std::string_view automatic = "auto";

/// One drawing setting: a key of [render], a command-line option and a session command.
struct DrawingKey {
  struct Words {
    std::string_view kind;
    std::vector<std::string> (*names)() = nullptr;  // all words except "auto"
    bool or_formula = false;                        // also takes "=EXPRESSION"
    bool is_list = false;                           // takes several words, separated by commas

    bool has_formula(const std::string& word) const { return or_formula && word.starts_with('='); }
    /// Returns the first word of `text` that is not allowed, or nullopt.
    std::optional<std::string> first_unknown(const std::string& text) const;
  };
  struct Numbers {
    std::size_t count = 1;
    bool whole = false;
    char between = ':';             // separator of typed numbers
    std::string_view in_file = {};  // form in scene files, shown in messages, e.g. "[low, high]"
    std::string typed = {};         // form on the command line, shown in messages
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  };

  std::string_view name;         // "font_size"
  std::string_view placeholder;  // in --help; ends in "|auto" if the key allows "auto"
  std::string_view help;
  std::string_view session_help = {};  // empty: not a session command
  bool allows_auto = false;            // as the value in scene files
  bool counts_frames = false;          // sets the number of pictures, not their look
  Words words = {};
  bool is_free_text = false;      // takes any text; typed "none" means empty
  std::string_view pattern = {};  // form of a valid text, for messages and the JSON schema
  Numbers numbers = {};
  /// Sets the value, or returns an error message. `apply_scene` (cli/scene) checks whether the value fits the scene.
  std::string (*set)(Drawing&, const DrawingValue&);
  DrawingValue (*get)(const Drawing&);

  bool takes_words() const { return words.names != nullptr; }
  std::string option() const;
};

/// In the order of --help and scene.toml.
std::span<const DrawingKey> drawing_keys();
const DrawingKey& drawing_key(std::string_view name);

/// Sets the key to a value typed by the user. Throws UsageError for a wrong value, without changing `drawing`.
void set_typed(Drawing& drawing, const DrawingKey& key, const std::string& text);

}  // namespace taut::cli
