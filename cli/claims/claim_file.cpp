#include "cli/claims/claim_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include <fmt/core.h>

#include "cli/claims/criterion.hpp"
#include "cli/scene/sections.hpp"
#include "cli/scene/shipped.hpp"
#include "cli/scene/toml_cursor.hpp"
#include "cli/sweep/sweep_file.hpp"
#include "cli/text/suggest.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array state_names{"holds", "in part", "does not hold"};

std::vector<Setting> settings_below(TomlCursor& above, TomlValue& table, const std::string& key,
                                    const std::string& what) {
  TomlCursor cursor = above.enter(table, key, what, keys_of("set"));
  return read_settings(cursor);
}

std::vector<ClaimRun> read_runs(TomlCursor& cursor) {
  std::vector<Setting> common;
  if (TomlValue* set = cursor.find("set")) common = settings_below(cursor, *set, "set", "'set'");
  TomlValue& runs = cursor.need("run");
  if (runs.kind != TomlValue::Kind::table || runs.entries.empty())
    cursor.fail(runs, "run", "run must contain a line NAME = { SETTINGS } for each run");
  std::vector<ClaimRun> all;
  for (TomlEntry& entry : runs.entries) {
    if (!is_identifier(entry.key))
      cursor.fail(
          entry.place, "run",
          fmt::format("'{}' is not a valid name for a run; use letters, digits and '_', with no digit first",
                      entry.key));
    if (entry.value.kind != TomlValue::Kind::table)
      cursor.fail(entry.value, "run",
                  fmt::format("the run {} must be a table {{ NAME = value }}", entry.key));
    all.push_back({entry.key, merged(common, settings_below(cursor, entry.value, "run." + entry.key,
                                                            fmt::format("run '{}'", entry.key)))});
  }
  return all;
}

std::string read_criterion(TomlCursor& cursor, std::string_view key, const std::vector<ClaimRun>& runs) {
  const TomlValue* value = cursor.find(key);
  if (!value) return "";
  const std::string text = cursor.text_of(*value, key);
  std::vector<std::string> names;
  for (const ClaimRun& run : runs) names.push_back(run.name);
  try {
    check_criterion(text, names);
  } catch (const UsageError& error) {
    cursor.fail(*value, key, error.what());
  }
  return text;
}

ClaimState read_state(TomlCursor& cursor) {
  return static_cast<ClaimState>(std::ranges::find(state_names, cursor.choice("state")) -
                                 state_names.begin());
}

Claim read_claim(TomlCursor& cursor, const fs::path& file) {
  Claim claim;
  claim.file = file;
  claim.paper = file.stem().string();
  claim.key = cursor.line("key");
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  if (claim.key.empty() || !std::ranges::all_of(claim.key, fits))
    cursor.fail(cursor.need("key"), "key",
                fmt::format("'{}' is not a valid key; use letters, digits, '_' and '-'", claim.key));
  claim.place = cursor.line("place");
  claim.text = cursor.text("text");
  claim.published = cursor.line("published", "");
  claim.looser = cursor.line("looser", "");
  claim.scene = find_scene_of(cursor, file);
  claim.quick = cursor.choice("cost") == "quick";
  claim.runs = read_runs(cursor);
  cursor.need("criterion");
  claim.criterion = read_criterion(cursor, "criterion", claim.runs);
  claim.part = read_criterion(cursor, "part", claim.runs);
  claim.evidence = read_criterion(cursor, "evidence", claim.runs);
  claim.state = read_state(cursor);
  claim.reason = cursor.text("reason", "");
  claim.last_run = cursor.line("last_run");
  const auto refuse = [&](std::string_view key, const std::string& message) {
    cursor.fail(cursor.table().place, key, fmt::format("the claim {} {}", claim.key, message));
  };
  if (claim.state != ClaimState::holds && claim.reason.empty())
    refuse("reason", fmt::format("has the state '{}' and needs a reason", name(claim.state)));
  if (claim.state == ClaimState::holds && !claim.reason.empty())
    refuse("reason", "has the state 'holds' and needs no reason; remove it, or write it into 'looser'");
  if (claim.state == ClaimState::in_part && claim.part.empty())
    refuse("part", "has the state 'in part' and needs the criterion 'part'");
  cursor.refuse_unknown_keys();
  return claim;
}

}  // namespace

std::string_view name(ClaimState state) { return state_names[static_cast<std::size_t>(state)]; }

Paper read_paper(const fs::path& file) {
  TomlSource source;
  source.file = file.string();
  TomlValue tree = parse_toml(file_text(file), source.file);
  TomlCursor root(tree, "", "the claim file", keys_of("claims"), {}, source);
  root.refuse_unknown_keys();
  Paper paper{file, file.stem().string(), root.line("title"), {}};
  root.need("claim");
  std::set<std::string> keys;
  for (TomlValue& value : root.list("claim")) {
    TomlCursor cursor = root.enter(value, "claim", "[[claim]]", keys_of("claim"));
    paper.claims.push_back(read_claim(cursor, file));
    if (!keys.insert(paper.claims.back().key).second)
      root.fail(value, "claim", fmt::format("the claim {} exists twice", paper.claims.back().key));
  }
  return paper;
}

std::vector<Paper> shipped_papers() {
  std::vector<Paper> papers;
  for (const std::string& name : paper_names()) papers.push_back(read_paper(find_paper(name)));
  return papers;
}

}  // namespace taut::cli
