#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/kernels_of.hpp"
#include "engine/solver/common.hpp"
#include "engine/solver/scheme.hpp"
#include "engine/solver/simulation.hpp"

namespace taut {

template <int Dim>
class ParticleSimulation final : public Simulation, private ProbeSource<Dim> {
 public:
  using V = Vec<double, Dim>;

  ParticleSimulation(std::unique_ptr<Common<Dim>> common, std::unique_ptr<Scheme<Dim>> scheme);

  void advance(double t, double short_of) override;
  std::string save() override;
  void load(std::string_view state) override;

 private:
  const RunState& run_state() const override { return common_->run; }
  void take_snapshot(Snapshot& out) const override;
  bool take_motion(Snapshot& out) const override { return scheme_->show_motion(out); }
  void record();

  ContactsOfFaces<Dim>* faces() override { return common_->contact.faces(); }
  V reaction(int i) override { return common_->external.reaction(common_->particles, i); }
  V contact_force(const Probe& probe, double dt) override { return scheme_->contact_force(probe, dt); }
  const Snapshot& shown(const std::vector<int>& stored) override;

  std::unique_ptr<Common<Dim>> common_;
  std::unique_ptr<Scheme<Dim>> scheme_;
  Snapshot probe_snapshot_;  // only the groups of particles that stress probes use are current
};

template <Family F, class Kernels, bool with_v4 = false>
const Kernels& kernels_for(const SolverInput& input) {
  return best_kernels<F, Kernels, with_v4>(input.scene.dim, input.method.name, input.kernels);
}

template <class Method, int Dim, class... More>
std::unique_ptr<Simulation> simulation_by(const SolverInput& input, double support, const More&... more) {
  auto common = std::make_unique<Common<Dim>>(input, support);
  auto scheme = std::make_unique<Method>(*common, input, more...);
  return std::make_unique<ParticleSimulation<Dim>>(std::move(common), std::move(scheme));
}

}  // namespace taut
