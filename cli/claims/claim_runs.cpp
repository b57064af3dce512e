#include "cli/claims/claim_runs.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/core.h>

#include "cli/claims/criterion.hpp"
#include "cli/text/format.hpp"
#include "engine/diagnostics/critical_step.hpp"
#include "engine/error.hpp"

namespace taut::cli {
namespace {

namespace fs = std::filesystem;

SweepRequest request_of(const Claim& claim, const fs::path& file, const fs::path& folder) {
  SweepRequest request;
  request.title = claim.name();
  request.file = file;
  request.base.scene = claim.scene;
  request.base.no_render = true;
  request.base.threads = 1;
  for (const ClaimRun& run : claim.runs) request.rows.push_back(run.settings);
  request.folder = folder / fs::path(claim.scene).stem();
  return request;
}

const SweepRun& run_named(const PlannedClaim& planned, const std::string& name) {
  const auto found = std::ranges::find(planned.claim->runs, name, &ClaimRun::name);
  return planned.plan.runs[static_cast<std::size_t>(found - planned.claim->runs.begin())];
}

QuantityValue critical_step(const Claim& claim, const SweepRun& run) {
  SceneFile file = read_scene(claim.scene, run.settings);
  file.settings.threads = 1;
  const CriticalStep found =
      find_critical_step(file.scene, file.settings, {}, [](const CriticalStep&) { return true; });
  if (!found.stable) throw UsageError("no time step is stable");
  return {*found.stable, six_digits(*found.stable) + " s"};
}

}  // namespace

std::vector<PlannedClaim> plan_claims(const std::vector<const Claim*>& claims, const fs::path& folder) {
  std::vector<PlannedClaim> all;
  for (const Claim* claim : claims) {
    try {
      all.push_back({claim, plan_sweep(request_of(*claim, claim->file, folder))});
    } catch (const UsageError& error) {
      throw UsageError(fmt::format("claim {}: {}", claim->name(), error.what()));
    }
  }
  return all;
}

std::vector<SweepRun*> unfinished_runs(std::vector<PlannedClaim>& claims) {
  std::vector<SweepRun*> all;
  std::set<std::string> folders;
  for (PlannedClaim& planned : claims)
    for (SweepRun& run : planned.plan.runs)
      if (run.state != SweepRunState::done && folders.insert(*run.options.out).second) all.push_back(&run);
  return all;
}

ClaimOutcome outcome_of(const PlannedClaim& planned) {
  const Claim& claim = *planned.claim;
  ClaimOutcome outcome{&claim};
  std::map<std::string, double> values;
  for (const Quantity& quantity : quantities_in(claim.criterion + " " + claim.part + " " + claim.evidence)) {
    const SweepRun& run = run_named(planned, quantity.run);
    try {
      if (run.state != SweepRunState::done)
        throw UsageError(run.problem.empty() ? "the run is not finished" : run.problem);
      const QuantityValue value = quantity.path == "critical_step"
                                      ? critical_step(claim, run)
                                      : value_of(*run.options.out, quantity.path);
      values[quantity.name()] = value.number;
      outcome.values.emplace_back(quantity.name(), value.shown);
    } catch (const UsageError& error) {
      outcome.problem = fmt::format("{}: {}", quantity.run, error.what());
      return outcome;
    }
  }
  const auto met = [&](const std::string& criterion) {
    return !criterion.empty() && is_met(criterion, values);
  };
  outcome.state = met(claim.criterion) ? ClaimState::holds
                  : met(claim.part)    ? ClaimState::in_part
                                       : ClaimState::does_not_hold;
  outcome.evidence = claim.evidence.empty() || met(claim.evidence);
  return outcome;
}

}  // namespace taut::cli
