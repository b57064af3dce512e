#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene.hpp"

namespace taut {

enum class Stepping { dual, single };  // [Zhang2024] §5: pair geometry held between advection steps, or not

/// Which build of the solver runs: the best that this machine has, or the one for any machine. The results
/// are the same to the last bit.
enum class InstructionSet { best, baseline };

/// How a scene is run; what is left out takes the method's published default.
struct Settings {
  std::string method = "enog";
  std::map<std::string, double> constants;  // a method's own constants by name, e.g. {"zeta", 4.0}
  std::string law;  // of elasticity, for a method that leaves it open (MethodInfo::laws); empty = its first
  Stepping stepping = Stepping::dual;
  double cfl = 0;   // acoustic step over h/(c0 + |v|max) (oenog: dp/(c_p + |v|max)); 0 = the method's default
  double step = 0;  // s, of every step; 0 = by cfl
  int threads = 0;  // 0 = all cores
  InstructionSet instruction_set = InstructionSet::best;
};

/// What bodies were given from outside.
struct Impulse {
  Point linear{};   // N s (per metre depth in 2D)
  Point angular{};  // about the origin, N m s; in 2D only the last component
};

/// The particles at one time, in the order of their creation, whatever order the solver keeps them in.
struct Snapshot {
  int dim = 2;
  double time = 0;  // s
  long step = 0;
  std::vector<double> x0;   // initial position, n × dim, m
  std::vector<double> x;    // position, n × dim, m
  std::vector<double> v;    // velocity, n × dim, m/s
  std::vector<double> m;    // mass (per metre depth in 2D), kg
  std::vector<double> rho;  // density, kg/m³
  std::vector<double> p;    // pressure, positive in compression, Pa
  std::vector<double> s;    // deviatoric stress xx, xy, yy, zz (2D) or xx, xy, xz, yy, yz, zz (3D), Pa
  std::vector<double>
      strain_energy;          // of methods that have one of their own, J (per metre depth in 2D); else empty
  double contact_energy = 0;  // of the contacts of bodies, J (per metre depth in 2D)
  double work = 0;            // of driven particles, loads and gravity so far, J (per metre depth in 2D)
  double damped = 0;          // taken by the scene's damping so far, J (per metre depth in 2D)
  Impulse of_walls;           // so far
  std::vector<double> diameter;  // of a particle as drawn: V0^(1/dim), m
  std::vector<int> body;         // index into Scene::bodies
  std::vector<int> material;     // index into Scene::materials
  std::vector<unsigned char> held;

  std::size_t size() const { return m.size(); }
};

/// Sums over all particles, of the state that `Snapshot` shows.
struct Balance {
  double kinetic = 0, strain = 0;  // J (per metre depth in 2D); strain with that of contacts
  Point linear_momentum{};         // kg m/s
  Point angular_momentum{};        // about the origin, kg m²/s; in 2D only the last component
  double momentum_scale = 0;       // Σ |m v|
  double angular_scale = 0;        // Σ m |x| |v|
  double work = 0;    // done so far by what drives, loads and pulls the bodies, J (per metre depth in 2D)
  double damped = 0;  // taken so far by the scene's damping, J (per metre depth in 2D)
  Impulse of_walls;   // so far: momenta less these are kept
};

/// The series of a scene's probes: one row per step.
struct Series {
  std::vector<double> time;                // s
  std::vector<std::vector<double>> value;  // [probe][step]

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time, value);
  }
};

/// A running simulation. Virtual calls are for whole stretches of it, never within a step.
class Simulation {
 public:
  virtual ~Simulation() = default;

  /// Steps until the first step at or past time `t` (never cut short: output does not alter a run), then
  /// refreshes `snapshot`. Throws NumericalError when a value is no longer finite.
  virtual void advance_to(double t) = 0;

  /// All that its next steps depend on, and the series so far, as bytes for `load`.
  virtual std::string save() = 0;
  /// Goes on where another simulation of the same scene and settings was saved, in this program on this kind
  /// of machine: the next steps give the same bytes. Throws UsageError for a state that is not one of those.
  virtual void load(std::string_view state) = 0;

  const Snapshot& snapshot() const { return snapshot_; }
  const Series& series() const { return series_; }
  double time() const { return snapshot_.time; }
  long steps() const { return snapshot_.step; }
  /// Directed pairs of neighbours, as of the last rebuild.
  long pairs() const { return pairs_; }
  double support() const { return support_; }  // radius of interaction, m
  /// Greatest number of threads in use.
  int threads() const { return threads_; }

 protected:
  Snapshot snapshot_;
  Series series_;
  long pairs_ = 0;
  double support_ = 0;
  int threads_ = 1;
};

/// Throws UsageError for an unknown method or constant, SceneError for a scene the method cannot run.
std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Settings& settings);

Balance balance(const Snapshot& now, const Scene& scene);

}  // namespace taut
