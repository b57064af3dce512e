#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cli/scene/scene_file.hpp"

namespace taut::cli {

enum class ClaimState { holds, in_part, does_not_hold };
/// "in part".
std::string_view name(ClaimState);

struct ClaimRun {
  std::string name;
  std::vector<Setting> settings;  // with those of the claim
};

/// A statement of a paper, with the runs and criteria that decide whether it holds here.
struct Claim {
  std::filesystem::path file;
  std::string paper, key;                // "Zhang2024", "fig-3a"
  std::string place, text;               // "Fig. 3(a)", the statement
  std::string published, looser;         // published value; difference of the criterion; may be empty
  std::string scene;                     // path
  bool quick = true;                     // the tests repeat it
  std::vector<ClaimRun> runs;            // at least one
  std::string criterion;                 // expression of quantities; see criterion.hpp
  std::string part, evidence;            // may be empty
  ClaimState state = ClaimState::holds;  // recorded
  std::string reason;                    // of a state other than holds
  std::string last_run;                  // date of the runs that confirmed the state

  /// "Zhang2024.fig-3a".
  std::string name() const { return paper + "." + key; }
};

/// A file of scenes/papers/, named after the paper's key.
struct Paper {
  std::filesystem::path file;
  std::string key, title;
  std::vector<Claim> claims;  // at least one
};

/// Reads a claim file. Throws SceneError with file, line and column; does not check the settings and quantities.
Paper read_paper(const std::filesystem::path& file);
/// Reads all claim files of the scene folders.
std::vector<Paper> shipped_papers();

}  // namespace taut::cli
