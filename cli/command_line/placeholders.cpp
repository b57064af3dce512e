#include "cli/command_line/placeholders.hpp"

#include <algorithm>

#include "cli/claims/claim_file.hpp"
#include "cli/drawing/keys.hpp"
#include "cli/language/reference.hpp"
#include "cli/scene/shipped.hpp"
#include "engine/judge/verdict.hpp"
#include "engine/methods/catalogue.hpp"

namespace taut::cli {
namespace {

using Words = std::vector<std::string>;

Words method_names(const SceneFile*) { return allowed_words("method"); }
Words shipped_scenes(const SceneFile*) { return scene_names(); }

Words sweep_names(const SceneFile*) {
  Words names = study_names();
  for (const std::string& scene : scene_names()) names.push_back(scene);
  return names;
}

Words claim_names(const SceneFile*) {
  Words names;
  for (const Paper& paper : shipped_papers())
    for (const Claim& claim : paper.claims) names.push_back(claim.name());
  return names;
}

Words shipped_suites(const SceneFile*) { return suite_names(); }

Words papers(const SceneFile*) { return paper_names(); }

Words section_names(const SceneFile*) { return topic_names(); }

Words color_names(const SceneFile*) { return {"white", "black"}; }

Words verdict_names(const SceneFile*) { return names_of_failures(); }

Words probe_names(const SceneFile* scene) {
  Words names;
  if (!scene) return names;
  for (const Probe& probe : scene->scene.probes) names.push_back(probe.name);
  return names;
}

Words column_names(const SceneFile* scene) {
  Words names{"t", "kinetic_energy", "strain_energy", "total_energy"};
  for (const std::string& probe : probe_names(scene)) names.push_back(probe);
  return names;
}

Words body_names(const SceneFile* scene) {
  Words names;
  if (!scene) return names;
  for (const Body& body : scene->scene.bodies) names.push_back(body.name);
  return names;
}

Words measure_names(const SceneFile* scene) {
  Words names;
  if (!scene) return names;
  for (const Measure& measure : scene->scene.measures) names.push_back(measure.name);
  return names;
}

Words line_names(const SceneFile* scene) {
  Words names;
  if (!scene) return names;
  for (const SampleLine& line : scene->scene.lines) names.push_back(line.name);
  return names;
}

Words settable_names(const SceneFile* scene) { return scene ? names_to_set(*scene) : Words(); }

Words beside_names(const SceneFile*) {
  Words names;
  for (const std::string_view key : keys_beside) names.push_back(std::string(key) + "=");
  return names;
}

struct Placeholder {
  std::string_view name;
  Words (*words)(const SceneFile*);
  std::string_view files;
};

constexpr Placeholder table[] = {
    {"SCENE", shipped_scenes, "*.toml"},
    {"SWEEP", sweep_names, "*.toml"},
    {"SUITE", shipped_suites, "*.toml"},
    {"PAPER", papers, ""},
    {"CLAIM", claim_names, ""},
    {"METHOD", method_names, ""},
    {"SECTION", section_names, ""},
    {"VERDICT", verdict_names, ""},
    {"PROBE", probe_names, ""},
    {"BODY", body_names, ""},
    {"COLOR", color_names, ""},
    {"COLUMN", column_names, ""},
    {"MEASURE", measure_names, ""},
    {"LINE", line_names, ""},
    {"PARAMETER", settable_names, ""},
    {"NAME=VALUE", settable_names, ""},
    {"NAME=VALUES", settable_names, ""},
    {"KEY=VALUE;...", beside_names, ""},
    {"DIR", nullptr, "*/"},
    {"FILE", nullptr, "*"},
    {"A", nullptr, "*.png"},  // folders are offered with every pattern
    {"B", nullptr, "*.png"},
};

const Placeholder* find_placeholder(std::string_view name) {
  const auto* found = std::ranges::find(table, name, &Placeholder::name);
  return found == std::end(table) ? nullptr : found;
}

Words drawing_names(std::string_view placeholder) {
  const auto keys = drawing_keys();
  const auto key = std::ranges::find_if(keys, [placeholder](const DrawingKey& each) {
    return each.placeholder.substr(0, each.placeholder.find_first_of("|,")) == placeholder;
  });
  return key != keys.end() && key->takes_words() ? key->words.names() : Words();
}

bool is_literal(std::string_view word) {
  return !word.empty() &&
         std::ranges::all_of(word, [](char c) { return (c >= 'a' && c <= 'z') || c == '-'; });
}

/// ".png" of "panel.png", or empty.
std::string_view extension(std::string_view word) {
  const std::size_t dot = word.rfind('.');
  return dot == std::string_view::npos || dot + 1 == word.size() ? "" : word.substr(dot);
}

std::vector<std::string_view> alternatives(std::string_view text) {
  std::vector<std::string_view> all;
  while (!text.empty()) {
    const std::size_t bar = std::min(text.find('|'), text.size());
    all.push_back(text.substr(0, bar));
    text.remove_prefix(std::min(bar + 1, text.size()));
  }
  return all;
}

bool drop_end(std::string_view& text, std::string_view end) {
  if (!text.ends_with(end)) return false;
  text.remove_suffix(end.size());
  return true;
}

/// "a,b," of "a,b,c".
std::string items_before(const std::string& typed) {
  const std::size_t comma = typed.rfind(',');
  return comma == std::string::npos ? "" : typed.substr(0, comma + 1);
}

void add(Choices& choices, const Words& words, const std::string& before, std::string_view behind = "") {
  for (const std::string& word : words) choices.words.push_back((before + word).append(behind));
}

void add_assignments(Choices& choices, const Words& names, bool several, const std::string& typed) {
  const std::size_t equals = typed.find('=');
  if (equals == std::string::npos) return add(choices, names, "", "=");
  const std::string before = typed.substr(0, equals + 1);
  const std::string items = several ? items_before(typed.substr(equals + 1)) : "";
  add(choices, allowed_words(typed.substr(0, equals)), before + items);
}

void add_alternative(Choices& choices, std::string_view name, const std::string& typed,
                     const SceneFile* scene) {
  const bool is_list = drop_end(name, ",...");
  if (const Words names = drawing_names(name); !names.empty()) {
    add(choices, names, is_list ? items_before(typed) : "");
  } else if (const Placeholder* placeholder = find_placeholder(name)) {
    if (!placeholder->files.empty()) choices.files = placeholder->files;
    const Words words = placeholder->words ? placeholder->words(scene) : Words();
    if (name.starts_with("NAME="))
      add_assignments(choices, words, name == "NAME=VALUES", typed);
    else
      add(choices, words, is_list ? items_before(typed) : "");
  } else if (is_literal(name)) {
    choices.words.emplace_back(name);
  } else if (!extension(name).empty()) {
    const std::string pattern = std::string("*").append(extension(name));
    choices.files = choices.files.empty() ? pattern : "*";
  }
}

}  // namespace

Choices choices(std::string_view placeholder, const std::string& typed, const SceneFile* scene) {
  drop_end(placeholder, " ...");
  if (placeholder.starts_with('[') && drop_end(placeholder, "]")) placeholder.remove_prefix(1);
  Choices result;
  for (const std::string_view name : alternatives(placeholder)) add_alternative(result, name, typed, scene);
  return result;
}

}  // namespace taut::cli
