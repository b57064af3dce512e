#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cli/scene/scene_file.hpp"

namespace taut::cli {

enum class ClaimState { holds, in_part, does_not_hold };
std::string_view name(ClaimState);

struct ClaimRun {
  std::string name;
  std::vector<Setting> settings;  // of the claim and the run
};

struct Claim {
  std::filesystem::path file;
  std::string paper, key;         // "Zhang2024", "fig-3a"
  std::string place, text;        // "Fig. 3(a)", the statement
  std::string published, looser;  // may be empty; `looser`: weakening of the criterion
  std::string scene;              // path
  bool quick = true;              // repeated by the tests
  std::vector<ClaimRun> runs;
  std::string criterion;
  std::string part, evidence;  // may be empty
  ClaimState state = ClaimState::holds;
  std::string reason;    // why the state is not `holds`
  std::string last_run;  // date, may have a remark

  std::string name() const { return paper + "." + key; }
};

struct Paper {
  std::filesystem::path file;
  std::string key, title;
  std::vector<Claim> claims;
};

/// Throws SceneError. Does not check whether settings and quantities exist.
Paper read_paper(const std::filesystem::path& file);
std::vector<Paper> shipped_papers();

}  // namespace taut::cli
