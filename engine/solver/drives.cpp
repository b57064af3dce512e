#include "engine/solver/drives.hpp"

namespace taut {

template <int Dim>
Drives<Dim>::Drives(const Scene& scene, const InitialParticles& initial) {
  std::vector<int> first;  // [body] index of its first drive
  for (const Body& body : scene.bodies) {
    first.push_back(static_cast<int>(drives_.size()));
    for (const Drive& drive : body.drives)
      drives_.push_back({drive.velocity, ends_before_run(drive, scene)
                                             ? *drive.until
                                             : std::numeric_limits<double>::infinity()});
  }
  if (drives_.empty()) return;
  for (int id = 0; id < initial.size(); ++id)
    drive_.push_back(initial.drive[id] < 0 ? -1 : first[initial.body[id]] + initial.drive[id]);
  work_.assign(drive_.size(), 0);
  active_ = true;
  set_time(0);
}

template <int Dim>
void Drives<Dim>::set_time(double t) {
  if (!active_) return;
  active_ = false;
  for (Timed& drive : drives_) {
    drive.on = t <= drive.until;
    active_ |= drive.on;
    for (int k = 0; k < Dim && drive.on; ++k) drive.now[k] = drive.velocity[k] ? drive.velocity[k](t) : 0;
  }
}

template class Drives<2>;
template class Drives<3>;

}  // namespace taut
