#pragma once

#include <array>
#include <functional>
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
using DrawingValues = std::map<std::string, DrawingValue, std::less<>>;

inline constexpr std::string_view nothing = "none";
inline constexpr std::string_view automatic = "auto";

/// A key of [render] and its command-line option; with `session_help` also a session command.
struct DrawingKey {
  struct Words {
    std::string_view kind;
    std::vector<std::string> (*names)() = nullptr;  // except "auto"
    bool or_formula = false;                        // allows "=EXPRESSION"
    bool is_list = false;

    bool has_formula(const std::string& word) const { return or_formula && word.starts_with('='); }
    std::optional<std::string> first_unknown(const std::string& text) const;
  };
  struct Numbers {
    std::size_t count = 1;
    bool whole = false;
    char between = ':';             // separates typed numbers
    std::string_view in_file = {};  // "[low, high]"
    std::string typed = {};
    double low = -1e100, high = 1e100;  // by default, squares and differences are finite
  };

  std::string_view name;
  std::string_view placeholder;  // ends in "|auto" if "auto" can be typed
  std::string_view help;
  std::string_view session_help = {};  // empty: no session command
  bool allows_auto = false;            // in scene files
  bool counts_frames = false;
  Words words = {};
  bool is_free_text = false;
  std::string_view pattern = {};
  Numbers numbers = {};
  /// Returns an error message, or "".
  std::string (*set)(Drawing&, const DrawingValue&);
  DrawingValue (*get)(const Drawing&);

  bool takes_words() const { return words.names != nullptr; }
  std::string option() const;
};

std::span<const DrawingKey> drawing_keys();

/// Keys of `compare --beside`.
inline constexpr std::array<std::string_view, 14> keys_beside{
    "color", "range", "colormap", "view",    "camera", "up",    "fov",
    "style", "cut",   "hide",     "outline", "follow", "glyph", "bar_format"};
const DrawingKey& drawing_key(std::string_view name);

/// Throws UsageError without changing `drawing`.
void set_typed(Drawing& drawing, const DrawingKey& key, const std::string& text);

}  // namespace taut::cli
