#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/contact/contact_law.hpp"
#include "engine/core/point.hpp"
#include "engine/scene/shape.hpp"

namespace taut {

/// Function of the reference position, evaluated at set-up only; empty = 0. A region is where it is not 0.
using Expression = std::function<double(const Point&)>;
/// Function of the position and the time, s.
using Solution = std::function<double(const Point&, double)>;

struct Material {
  std::string name;
  double density = 0;             // ρ0, kg/m³
  double youngs_modulus = 0;      // E, Pa
  double poisson_ratio = 0;       // ν
  double given_bulk_modulus = 0;  // Pa; 0 = from E and ν. K = E in [Khayyer2024] Eq. 57
  std::map<std::string, double, std::less<>> law_parameters{};  // LawRow::parameters

  double bulk_modulus() const {  // K, Pa
    return given_bulk_modulus > 0 ? given_bulk_modulus : youngs_modulus / (3 * (1 - 2 * poisson_ratio));
  }
  double shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }  // G, Pa
  double sound_speed() const;  // c0 = √(K/ρ0), m/s [Zhang2024] Eq. 5
};

struct Part {
  int material = 0;
  Expression where;
};

struct Drive {
  Expression where;
  std::array<std::function<double(double)>, 3> velocity;  // m/s, of the time in s; empty = 0
  std::optional<double> until;                            // s; none = never released
};

struct Load {
  enum class Kind : std::uint8_t {
    force,          // N (2D: N/m), shared by volume
    force_density,  // N/m³ of initial volume
    traction,       // Pa, on an outer face
  };
  Expression where;
  Kind kind{};
  std::array<Expression, 3> value;
  std::function<double(double)> ramp;  // of the time in s; empty = 1
};

std::string_view name(Load::Kind kind);

/// A rigid half-space. Acts by the contact law; with `sph`, by the penalty law.
struct Wall {
  std::string name;
  Point at{};      // m
  Point normal{};  // towards bodies
};

/// Lattice with dp² (dp³) per particle.
enum class Lattice : std::uint8_t {
  square,     // 3D: cubic
  hexagonal,  // 2D only; rows along the longer side
};
std::string_view name(Lattice lattice);
/// Row distance in spacings, √(√3/2); its inverse is the distance within a row.
inline constexpr double hexagonal_row = 0.93060485910209959893;

/// Right-handed rotation; `angle` in degrees.
struct Rotation {
  Point axis{0, 0, 1};  // unit vector
  Point about{};        // m
  double angle = 0;
};
/// Sines and cosines of quarter turns are exact; mirrored rotations of mirrored points give exact mirror images.
Point rotated(const Rotation& rotation, const Point& x);

/// Uniform within ± `share` spacings.
struct Jitter {
  static constexpr double least_unusable = 0.5;  // particles of a square lattice can coincide
  double share = 0;
  int seed = 1;
};

struct Body {
  std::string name;
  std::vector<Shape> shapes;  // the first one anchors the lattice
  std::vector<Shape> without;
  Lattice lattice = Lattice::square;
  bool relaxed = false;      // particles move to follow the faces
  bool on_boundary = false;  // one box with particles on its faces
  int material = 0;
  std::vector<Part> parts;             // the last that contains a particle counts
  std::vector<Drive> drives;           // as for parts
  std::vector<Load> loads;             // add up
  std::array<Expression, 3> velocity;  // m/s
  Expression clamped;
  std::array<Expression, 3> guided;        // [axis] region fixed along that axis
  std::array<bool, 3> mirror{};            // about the first shape's centre
  std::optional<Rotation> rotation;        // after reflection
  std::array<Expression, 3> displacement;  // m
};

/// Whether x is inside, or at most `tolerance` outside; ignores displacements.
bool holds(const Body& body, const Point& x, int dim, double tolerance);

/// Body before rotation and reflection, shifted such that x → −x reflects it into place.
Body unplaced_body(Body body, int dim);
/// Maps a point of unplaced_body(body) to its place.
Point placed(const Body& body, Point x, int dim);
Point unplaced_point(const Body& body, Point x, int dim);

/// Stress component, positive in tension, or invariant, Pa.
enum class StressPart : std::uint8_t { xx, yy, zz, xy, xz, yz, von_mises, pressure };

/// Sampled in every step. Forces are means over the last step, 0 at the start.
struct Probe {
  /// Unless stated, quantities of `bodies[0]`, component `axis`.
  struct Kind {
    std::string_view name;
    bool is_force = false;

    bool operator==(const Kind&) const = default;

    static const Kind displacement, position, velocity;
    static const Kind distance;                      // from `at` to `to`, m
    static const Kind mean_velocity, mean_position;  // mass-weighted
    static const Kind greatest_position;
    // least distance between faces, or between particles minus their mean diameter, m
    static const Kind gap;
    // greatest |x_a − mirror(x_b)| of one or two bodies, mirror plane ⊥ axis, m
    static const Kind mirror_asymmetry;
    // angle of `at` about `turns_about`, with whole turns, rad
    static const Kind turn;
    static const Kind stress;  // `part`, Pa
    // on clamped, guided or driven particles, N
    static const Kind reaction;
    static const Kind contact_force;  // on `bodies[0]`, from `bodies[1]` or `wall`, N
    static const Kind expression;
  };
  std::string name;
  Kind kind = Kind::displacement;
  std::vector<int> bodies;
  Point at{}, to{};
  int axis = 0;
  Point turns_about{0, 0, 1};  // axis through the origin, unit vector
  StressPart part{};
  Expression where;  // region of a reaction; empty = all
  int wall = -1;
  /// Function of the preceding probes' values and the time, s.
  std::function<double(const std::vector<double>&, double)> value;
  bool of_forces = false;
};

inline constexpr Probe::Kind Probe::Kind::displacement{"displacement"}, Probe::Kind::position{"position"},
    Probe::Kind::velocity{"velocity"}, Probe::Kind::distance{"distance"},
    Probe::Kind::mean_velocity{"mean_velocity"}, Probe::Kind::mean_position{"mean_position"},
    Probe::Kind::greatest_position{"greatest_position"}, Probe::Kind::gap{"gap"},
    Probe::Kind::mirror_asymmetry{"mirror_asymmetry"}, Probe::Kind::turn{"turn"},
    Probe::Kind::stress{"stress"}, Probe::Kind::reaction{"reaction", true},
    Probe::Kind::contact_force{"contact_force", true}, Probe::Kind::expression{"expression"};

inline bool is_step_mean(const Probe& probe) { return probe.kind.is_force || probe.of_forces; }

struct SampleLine {
  std::string name;
  int body = 0;
  std::string field;      // key
  Point from{}, to{};     // m
  bool in_space = false;  // not at material points
  int points = 0;
  std::vector<double> times;  // s, increasing
};

struct Measure {
  std::string name;
  std::string kind;                 // see diagnostics/measure_kinds.hpp
  std::vector<std::string> probes;  // one, or one per axis
  std::string line;
  int body = 0;
  std::vector<std::string> fields;  // compared components
  bool rigid_motion_free = false;   // ignores a small rigid motion
  std::string unit;
  double threshold = 0;
  double scale = 1;
  std::array<double, 2> band{};  // Hz
  double about = 0;              // level about which the series oscillates
  bool about_mean = false;       // level = mean over whole periods
  double from = 0;               // s
  std::optional<double> until;   // s; none = end
  double time = 0;               // s
  std::string free;              // probe of the gap between separating bodies
  Point axis{0, 0, 1};           // in 3D
};

/// Values over time, one column per probe, or along a line; linearly interpolated.
struct ReferenceTable {
  std::vector<double> t;                   // s, or m along a line
  std::vector<std::vector<double>> value;  // [column][row]
};

struct Reference {
  std::string name;                       // lists all sources
  std::map<std::string, double> value{};  // by measure
  std::map<std::string, ReferenceTable> table{};
  std::map<std::string, std::vector<Solution>> solution{};  // by measure; one per probe, field or line
  std::map<std::string, std::string> names{};               // by measure

  bool has(const std::string& measure) const {
    return value.contains(measure) || table.contains(measure) || solution.contains(measure);
  }
  const std::string& name_for(const std::string& measure) const {
    const auto own = names.find(measure);
    return own == names.end() ? name : own->second;
  }
};

struct Scene {
  std::string name;
  std::string title;
  std::string source;
  int dim = 2;
  double spacing = 0;     // dp, m
  int element_order = 0;  // of finite elements; 0 = particles
  Jitter jitter;
  double until = 0;  // s
  std::vector<Material> materials;
  std::vector<Body> bodies;
  std::vector<Wall> walls;
  ContactLaw contact = ContactLaw::published;
  std::array<std::function<double(double)>, 3> gravity;  // m/s², of the time in s; empty = 0
  double damping = 0;                                    // c, 1/s, of a force −c m v
  std::vector<Probe> probes;
  std::vector<SampleLine> lines;
  std::vector<Measure> measures;
  /// By the material law of a method, such as "2d_deviator".
  std::map<std::string, Reference> references;
};

/// Returns false if the drive and the run end at the same time.
bool ends_before_run(const Drive& drive, const Scene& scene);
/// Returns −1 if no region contains x.
template <class Region>
int last_that_holds(const std::vector<Region>& regions, const Point& x) {
  int k = static_cast<int>(regions.size()) - 1;
  while (k >= 0 && !(regions[k].where && regions[k].where(x) != 0)) --k;
  return k;
}
bool has_drives(const Scene& scene);
bool has_displacements(const Scene& scene);
bool is_undisplaced(const Body& body);
Point displaced(const Body& body, const Point& x);
bool has_guides(const Scene& scene);
bool has_gravity(const Scene& scene);
bool has_loads(const Scene& scene);

/// Adjusts `spacing` to divide `extent_to_divide` of the first shape evenly.
double fitted_spacing(const Body& first, int dim, double spacing);

}  // namespace taut
