#include "engine/solver/probes.hpp"

#include <cmath>

namespace taut {

template <int Dim>
ProbeRecorder<Dim>::ProbeRecorder(const Scene& scene, const InitialParticles& initial, double support)
    : first_(initial.first) {
  for (int i = 0; i < initial.size(); ++i)
    diameter_.push_back(std::pow(initial.V0[i] / initial.inside[i], 1.0 / Dim));
  const ProbeSetUp set_up{scene, initial, reach_of_points(support, scene.spacing)};
  for (const Probe& probe : scene.probes) {
    ProbeFollower<Dim>& f = followers_.emplace_back();
    f.probe = probe;
    f.row = &probe_row<Dim>(probe);
    if (f.row->set_up) f.row->set_up(f, set_up);
    if (f.row->takes_stress)
      for (const PointWeight& w : f.at) stressed_.push_back(w.particle);
  }
}

template <int Dim>
void ProbeRecorder<Dim>::rebuilt(const Particles<Dim>& s, const Neighbors& neighbors, double support) {
  support_ = support;
  storage_of_id_ = s.places_of_ids();
  for (ProbeFollower<Dim>& f : followers_)
    if (f.row->rebuilt) f.row->rebuilt(f, view(s), neighbors);
}

template <int Dim>
void ProbeRecorder<Dim>::record(const Particles<Dim>& s, double time, ProbeSource<Dim>& source,
                                Series& series) {
  const double dt = series.time.empty() ? 0 : time - series.time.back();
  series.value.resize(followers_.size());
  series.time.push_back(time);
  constexpr std::size_t now_and_then = 32;  // steps
  std::vector<int> stressed = stressed_;
  for (int& i : stressed) i = storage_of_id_[i];
  std::vector<double> values;
  const ProbeStep<Dim> step{view(s),
                            source,
                            stressed.empty() ? nullptr : &source.shown(stressed),
                            time,
                            dt,
                            values,
                            series.time.size() % now_and_then == 1};
  for (std::size_t k = 0; k < followers_.size(); ++k) {
    ProbeFollower<Dim>& f = followers_[k];
    values.push_back(dt > 0 || !f.probe.kind.is_force ? f.row->value(f, step) : 0);
    series.value[k].push_back(values.back());
  }
}

template class ProbeRecorder<2>;
template class ProbeRecorder<3>;

}  // namespace taut
