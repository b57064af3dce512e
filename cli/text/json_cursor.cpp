#include "cli/text/json_cursor.hpp"

#include <algorithm>

#include "cli/text/format.hpp"
#include "cli/text/json.hpp"
#include "cli/text/shown.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

const Json nothing;  // null

enum class Kind { text, number, object, choice_of_status, choice_of_verdict };

/// "*" stands for every key.
struct KeyOfRun {
  std::vector<std::string> path;
  Kind kind;
};

const std::vector<KeyOfRun>& keys_of_run() {
  using enum Kind;
  static const std::vector<KeyOfRun> keys = {
      {{"taut"}, text},
      {{"format"}, number},
      {{"scene"}, text},
      {{"method"}, text},
      {{"material_law"}, text},
      {{"remark"}, text},
      {{"contact"}, text},
      {{"stepping"}, text},
      {{"cfl"}, number},
      {{"parameters", "*"}, number},
      {{"dim"}, number},
      {{"spacing"}, number},
      {{"spacing_asked"}, number},
      {{"jitter"}, number},
      {{"jitter_seed"}, number},
      {{"particles"}, number},
      {{"mass"}, number},
      {{"until"}, number},
      {{"reached"}, number},
      {{"status"}, choice_of_status},
      {{"reason"}, text},
      {{"steps"}, number},
      {{"threads"}, number},
      {{"machine"}, text},
      {{"seconds", "*"}, number},
      {{"particle_steps_per_second"}, number},
      {{"verdict"}, choice_of_verdict},
      {{"since", "*"}, number},
      {{"beyond_law", "*"}, number},
      {{"warnings", "*", "*"}, number},
      {{"indicators"}, object},
      {{"conservation", "*"}, number},
      {{"energy_note"}, text},
      {{"measures", "*", "value"}, number},
      {{"measures", "*", "unit"}, text},
      {{"measures", "*", "reference"}, number},
      {{"measures", "*", "kind"}, text},
      {{"measures", "*", "reference_name"}, text},
      {{"measures", "*", "error"}, number},
      {{"measures", "*", "why"}, text},
      {{"provenance"}, object},
  };
  return keys;
}

const std::vector<std::string> states = {"running", "finished", "interrupted", "failed"};

void check(const JsonCursor& value, Kind kind, const std::vector<std::string>& verdicts) {
  if (kind == Kind::text) value.text();
  if (kind == Kind::number) value.check_number_or_null();
  if (kind == Kind::object && !value.is_null()) value.check_object();
  if (kind == Kind::choice_of_status) value.choice(states);
  if (kind == Kind::choice_of_verdict) value.choice(verdicts);
}

void check_below(const JsonCursor& value, const KeyOfRun& key, std::size_t part,
                 const std::vector<std::string>& verdicts) {
  if (part == key.path.size()) return check(value, key.kind, verdicts);
  if (value.is_null()) return;
  if (key.path[part] != "*") return check_below(value.at(key.path[part]), key, part + 1, verdicts);
  for (const auto& member : value.members()) check_below(member.second, key, part + 1, verdicts);
}

}  // namespace

Json parse_run_json(const std::string& text, const std::string& file,
                    const std::vector<std::string>& verdicts) {
  Json json = parse_json(text, file);
  if (!json.find("taut"))
    throw UsageError("'" + file +
                     "' is not the run.json of a run of taut: the key 'taut' is missing; repeat the run");
  const JsonCursor record(json, file);
  for (const KeyOfRun& key : keys_of_run()) check_below(record, key, 0, verdicts);
  return json;
}

JsonCursor::JsonCursor(const Json& value, const std::string& file, std::string path)
    : value_(&value), file_(&file), path_(std::move(path)) {}

bool JsonCursor::is_null() const { return value_->is_null(); }

JsonCursor JsonCursor::at(const std::string& key) const {
  check_object();
  const Json* found = value_->find(key);
  return {found ? *found : nothing, *file_, path_.empty() ? key : path_ + "." + key};
}

std::vector<std::pair<std::string, JsonCursor>> JsonCursor::members() const {
  std::vector<std::pair<std::string, JsonCursor>> all;
  if (is_null()) return all;
  check_object();
  for (const auto& member : value_->members()) all.emplace_back(member.first, at(member.first));
  return all;
}

std::vector<JsonCursor> JsonCursor::items() const {
  std::vector<JsonCursor> all;
  if (is_null()) return all;
  if (!value_->is_array()) fail("an array");
  for (const Json& item : value_->items())
    all.emplace_back(item, *file_, path_ + "." + std::to_string(all.size()));
  return all;
}

std::string JsonCursor::text() const {
  if (is_null()) return "";
  if (!value_->is_text()) fail("a text");
  return value_->text();
}

std::string JsonCursor::number_or_text() const {
  if (!value_->is_text() && !value_->is_number()) fail("a number or a text");
  return value_->is_text() ? value_->text() : value_->dump();
}

void JsonCursor::check_object() const {
  if (!value_->is_object()) fail("an object");
}

void JsonCursor::check_number_or_null() const {
  if (!is_null() && !value_->is_number()) fail("a number");
}

std::string JsonCursor::choice(const std::vector<std::string>& allowed) const {
  if (is_null()) return "";
  const bool known = value_->is_text() && std::ranges::count(allowed, value_->text()) > 0;
  if (!known) fail("one of " + join(allowed));
  return value_->text();
}

void JsonCursor::fail(const std::string& allowed) const {
  const std::string is = shown(value_->dump(), 60);
  if (path_.empty()) throw UsageError("'" + *file_ + "' contains " + is + "; it must be " + allowed);
  throw UsageError("'" + *file_ + "': key '" + shown(path_) + "' is " + is + "; it must be " + allowed);
}

}  // namespace taut::cli
