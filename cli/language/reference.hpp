#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace taut::cli {

struct Topic {
  std::string name;
  std::string header;  // "[[body]]"
  std::string help;
  std::vector<std::vector<std::string>> rows;  // column names first
  std::string example;
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

/// Topics, or else keys, of this name.
std::vector<Topic> find_topics(std::string_view name);
/// Excludes keys.
std::vector<std::string> topic_names();

std::string as_text(const Topic& topic, std::optional<std::size_t> columns = {});
std::string as_text(const LanguageFile& file, std::optional<std::size_t> columns = {});
/// Content of scenes/LANGUAGE.md.
std::string language_page();

// column names first
using Rows = std::vector<std::vector<std::string>>;
Rows shape_rows();
Rows probe_rows();
Rows measure_rows();
Rows law_rows();
Rows contact_rows();
Rows field_rows();
Rows colormap_rows();
Rows method_rows();
Rows key_rows();

/// May be empty.
std::string_view example_of(std::string_view name);

}  // namespace taut::cli
