#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Reference of the language of scene, sweep, claim and suite files, generated from the tables that the readers use.
namespace taut::cli {

/// A section, a list such as the shapes, or one shape, ...
struct Topic {
  std::string name;
  std::string header;  // "[[body]]"
  std::string help;
  std::vector<std::vector<std::string>> rows;  // the first row is the header
  std::string example;                         // TOML, or empty
};

struct LanguageFile {
  std::string name;
  std::vector<std::string> rules;
  std::vector<Topic> topics;
};
LanguageFile scene_language();
LanguageFile sweep_language();
LanguageFile claim_language();
LanguageFile suite_language();

/// Topics called `name`: sections, lists, shapes, probes, measures, laws, fields or colour maps, and keys only if
/// nothing else has this name. Several if a probe and a measure share a name; empty if there is none.
std::vector<Topic> find_topics(std::string_view name);
/// Names of all topics except keys.
std::vector<std::string> topic_names();

/// Text for a terminal, wrapped to `columns` if given.
std::string as_text(const Topic& topic, std::optional<std::size_t> columns = {});
std::string as_text(const LanguageFile& file, std::optional<std::size_t> columns = {});
/// Content of scenes/LANGUAGE.md.
std::string language_page();

// the first row is the header
using Rows = std::vector<std::vector<std::string>>;
Rows shape_rows();
Rows probe_rows();
Rows measure_rows();
Rows law_rows();
Rows contact_rows();
Rows field_rows();
Rows colormap_rows();
Rows method_rows();
/// Keys of all sections and kinds.
Rows key_rows();

/// Example of a section or shape, or empty.
std::string_view example_of(std::string_view name);

}  // namespace taut::cli
