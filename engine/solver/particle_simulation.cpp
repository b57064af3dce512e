#include "engine/solver/particle_simulation.hpp"

#include <numeric>
#include <set>
#include <utility>

#include "engine/error.hpp"

namespace taut {

template <int Dim>
ParticleSimulation<Dim>::ParticleSimulation(std::unique_ptr<Common<Dim>> common,
                                            std::unique_ptr<Scheme<Dim>> scheme)
    : common_(std::move(common)), scheme_(std::move(scheme)) {
  record();
}

template <int Dim>
void ParticleSimulation<Dim>::advance(double t, double short_of) {
  Common<Dim>& c = *common_;
  const bool outdated = outdated_;
  const long first = c.run.steps;
  outdated_ = !has_snapshot();  // a diverged run keeps its last snapshot
  c.stepping = true;
  c.team.resume();
  c.refuse_divergence();  // if the last call diverged
  try {
    while (c.run.time < t && !asked_to_stop()) {
      const double dt = scheme_->step_size();
      if (c.run.time + dt >= short_of) break;
      scheme_->step(dt);
      record();
      c.team.step_done();
    }
  } catch (NumericalError& e) {
    e.step = c.run.steps, e.time = c.run.time;
    throw;
  }
  outdated_ = outdated || c.run.steps > first;
}

template <int Dim>
std::string ParticleSimulation<Dim>::save() {
  common_->refuse_divergence();
  Saver saver;
  common_->serialize(saver, [this](Saver& to) { scheme_->save(to); });
  return saver.take();
}

template <int Dim>
void ParticleSimulation<Dim>::load(std::string_view state) {
  Loader loader(state);
  common_->serialize(loader, [this](Loader& from) { scheme_->load(from); });
  loader.finish();
  loader.check("the time step", [&] { return common_->run.time + scheme_->step_size() > common_->run.time; });
  outdated_ = true;
}

template <int Dim>
void ParticleSimulation<Dim>::take_snapshot(Snapshot& out) const {
  common_->begin_snapshot(out);
  std::vector<int> groups(static_cast<std::size_t>((common_->size() + lanes - 1) / lanes));
  std::iota(groups.begin(), groups.end(), 0);
  scheme_->show(out, groups);
}

template <int Dim>
const Snapshot& ParticleSimulation<Dim>::shown(const std::vector<int>& stored) {
  if (probe_snapshot_.m.empty()) common_->begin_snapshot(probe_snapshot_);
  std::set<int> some;
  for (const int i : stored) some.insert(i / lanes);
  scheme_->show(probe_snapshot_, std::vector<int>(some.begin(), some.end()));
  return probe_snapshot_;
}

template <int Dim>
void ParticleSimulation<Dim>::record() {
  Common<Dim>& c = *common_;
  if (c.probes.size() > 0) c.probes.record(c.particles, c.run.time, *this, c.run.series);
}

template class ParticleSimulation<2>;
template class ParticleSimulation<3>;

}  // namespace taut
