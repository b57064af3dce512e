#pragma once

#include <span>
#include <string_view>

namespace taut::cli {

/// A key of a scene or sweep file, as the reference of the language says it.
struct KeyInfo {
  std::string_view name;        // or `any_name`
  std::string_view value;       // what it takes, with its unit: "[x, y], m"
  std::string_view by_default;  // empty: the key is needed
  std::string_view help;
};

/// The name of a key that whoever writes the file chooses.
inline constexpr std::string_view any_name = "NAME";
/// Of a table whose keys are all such.
inline constexpr KeyInfo named_by_user[] = {{any_name, "", "", ""}};

/// A table of a scene or sweep file: what `taut describe` says of it, and the keys that its reader may ask
/// for.
struct Section {
  std::string_view name;    // "driven"
  std::string_view header;  // as it is written: "[[body]]"
  std::string_view help;
  std::span<const KeyInfo> keys;
};

/// Those of a scene file, the file itself first. Shapes, probes and measures have more keys, by their kind.
std::span<const Section> scene_sections();
/// Those of a sweep file.
std::span<const Section> sweep_sections();
/// The keys of one of either.
std::span<const KeyInfo> keys_of(std::string_view section);

}  // namespace taut::cli
