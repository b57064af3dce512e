#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The reference of the language of scene and sweep files, from the tables that the readers read by.
namespace taut::cli {

/// Something that has a name in there: a section, the shapes, one shape, ...
struct Topic {
  std::string name;    // "body"
  std::string header;  // as it is written: "[[body]]"
  std::string help;
  std::vector<std::vector<std::string>> rows;  // the first one holds their heads
  std::string example;                         // TOML; or empty
};

/// A file of the language, in the order in which it is explained.
struct LanguageFile {
  std::string name;                // "scene-file"
  std::vector<std::string> rules;  // paragraphs
  std::vector<Topic> topics;
};
LanguageFile scene_language();
LanguageFile sweep_language();

/// The topics called `name`: sections, lists ("shapes"), shapes, probes, measures, laws, contact laws, fields, colour
/// maps; keys where none of these has the name. Several if a probe and a measure share a name; empty if none does.
std::vector<Topic> find_topics(std::string_view name);
/// Names of all topics but the keys.
std::vector<std::string> topic_names();

/// For a terminal of so many columns; without a number nothing is wrapped.
std::string as_text(const Topic& topic, std::optional<std::size_t> columns = {});
std::string as_text(const LanguageFile& file, std::optional<std::size_t> columns = {});
/// Both files as scenes/LANGUAGE.md has them.
std::string language_page();

// rows of lists, the first one holds their heads
using Rows = std::vector<std::vector<std::string>>;
Rows shape_rows();
Rows probe_rows();
Rows measure_rows();
Rows law_rows();
Rows contact_rows();
Rows field_rows();
Rows colormap_rows();
Rows method_rows();
/// Every key of every section and kind.
Rows key_rows();

/// What stands in the reference for a section of `scene_sections`, `sweep_sections` or a shape; empty if
/// there is none.
std::string_view example_of(std::string_view name);

}  // namespace taut::cli
