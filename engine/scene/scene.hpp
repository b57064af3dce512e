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

/// A function of the position in the initial configuration, evaluated at set-up only.
using Expression = std::function<double(const Point&)>;
/// A function of the position in the initial configuration and of the time in s.
using Solution = std::function<double(const Point&, double)>;

struct Material {
  std::string name;
  double density = 0;             // ρ0, kg/m³
  double youngs_modulus = 0;      // E, Pa
  double poisson_ratio = 0;       // ν
  double given_bulk_modulus = 0;  // Pa; 0 = the one of E and ν. [Khayyer2024] §4.5 takes E, Eq. 57
  std::map<std::string, double, std::less<>> of_laws{};  // given LawRow::parameters, by key

  double bulk_modulus() const {  // K, Pa
    return given_bulk_modulus > 0 ? given_bulk_modulus : youngs_modulus / (3 * (1 - 2 * poisson_ratio));
  }
  double shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }  // G, Pa
  double sound_speed() const;  // c0 = √(K/ρ0), m/s [Zhang2024] Eq. 5
};

/// A region of a body that is made of another material.
struct Part {
  int material = 0;  // index into Scene::materials
  Expression where;  // particles where it is not 0
};

/// A region of a body that is moved: its particles have this velocity up to a time, and are free from then
/// on.
struct Drive {
  Expression where;                                       // particles where it is not 0
  std::array<std::function<double(double)>, 3> velocity;  // m/s, of the time in s; empty = 0
  std::optional<double> until;                            // s; none = never let go
};

/// Forces from outside on a region of a body, which move with its particles. Loads of several regions add up.
/// What is held or driven does not feel them.
struct Load {
  enum class Kind : std::uint8_t {
    force,  // N (per metre depth in 2D), spread by volume over the particles of the region that are ever free
    force_density,  // N/m³ of the initial volume
    traction,       // Pa, on the outer face of a layer that is one spacing deep; see solver/face_loads.hpp
  };
  Expression where;  // particles where it is not 0
  Kind kind{};
  std::array<Expression, 3> value;     // empty = 0
  std::function<double(double)> ramp;  // factor, of the time in s; empty = 1
};

std::string_view name(Load::Kind kind);

/// A rigid half-space that bodies cannot enter; it acts by the law of contact, by the penalty where that is
/// `sph`.
struct Wall {
  std::string name;
  Point at{};      // of its face, m
  Point normal{};  // of length 1, to the side of the bodies
};

/// How a body is filled that does not lay its own particles; each has dp² of the area (dp³) in both.
enum class Lattice : std::uint8_t {
  square,     // in 3D cubic
  hexagonal,  // 2D: of equilateral triangles, rows along the longer side of the first shape
};
std::string_view name(Lattice lattice);
/// Rows of a hexagonal lattice are this many spacings apart, √(√3/2); particles in a row 1 over it.
inline constexpr double hexagonal_row = 0.93060485910209959893;

/// A turn by `angle`, in degrees by the right-hand rule.
struct Rotation {
  Point axis{0, 0, 1};  // of length 1; in 2D z
  Point about{};        // m
  double angle = 0;
};
/// Where the point x comes to. Quarters of a turn and mirror images are exact to the last bit.
Point rotated(const Rotation& rotation, const Point& x);

/// Particles that lie at random: each free component of a place of the layout is moved by a number that is
/// evenly distributed up to `share` of the spacing to either side.
struct Jitter {
  static constexpr double least_unusable = 0.5;  // share at which two particles of a square lattice can meet
  double share = 0;
  int seed = 1;  // others give other numbers; bodies of the same shape get the same ones
};

struct Body {
  std::string name;
  std::vector<Shape> shapes;   // their union; the first one anchors the lattice
  std::vector<Shape> without;  // cut out of it
  Lattice lattice = Lattice::square;
  bool on_boundary = false;            // of one box: the outermost particles stand on its faces
  int material = 0;                    // index into Scene::materials
  std::vector<Part> parts;             // of other materials; of several that hold the last counts
  std::vector<Drive> drives;           // of several that hold the last counts
  std::vector<Load> loads;             // those of all that hold
  std::array<Expression, 3> velocity;  // initial velocity, m/s; empty = 0
  Expression held;                     // particles where it is not 0 stay where they are; empty = none
  std::array<Expression, 3> guided;    // those where it is not 0 do not move along this axis; empty = none
  std::array<bool, 3> mirror{};  // the layout is reflected along these axes about the first shape's centre
  std::optional<Rotation> rotation;        // of the layout, after that
  std::array<Expression, 3> displacement;  // from the reference configuration to the start, m; empty = 0
};

/// The place x lies in the body as it is laid, or at most `tolerance` outside; the displacement does not
/// count.
bool holds(const Body& body, const Point& x, int dim, double tolerance);

/// The body as it is laid before it is reflected and rotated: shapes about c that are reflected stand about
/// −c.
Body as_laid(Body body, int dim);
/// Where a place of the body as it is laid comes to.
Point placed(const Body& body, Point x, int dim);
/// The way back.
Point laid_at(const Body& body, Point x, int dim);

/// What of a Cauchy stress is looked at, Pa: a component, positive in tension, or an invariant.
enum class StressPart : std::uint8_t { xx, yy, zz, xy, xz, yz, von_mises, pressure };

/// A quantity followed at every step. Forces are means over the step before, 0 at the start, and in 2D per
/// metre of depth.
struct Probe {
  /// A kind of probe, by its name in scene files. solver/probe_kinds.cpp has a row for each kind.
  struct Kind {
    std::string_view name;
    bool is_force = false;  // values are means over the last step, in N

    bool operator==(const Kind&) const = default;

    // kinds that are named in code; any other one is Kind{"its name"}
    static const Kind displacement, position,
        velocity;                // of material point `at` of `bodies[0]`, component `axis`
    static const Kind distance;  // between material points `at` and `to` of `bodies[0]`, m
    static const Kind mean_velocity, mean_position;  // mass-weighted, of `bodies[0]`, component `axis`
    static const Kind greatest_position;             // of any particle of `bodies[0]`, component `axis`, m
    // least distance of two particles of `bodies[0]` and `bodies[1]` less their mean diameter, or between faces, m
    static const Kind gap;
    // largest |x_a − mirror(x_b)| over particles of two bodies of equal layout, or of one body that is its own image,
    // plane ⊥ axis, m
    static const Kind mirror_asymmetry;
    // angle of material point `at` of `bodies[0]` about `turns_about` since the start, whole turns included, rad
    static const Kind turn;
    static const Kind stress;  // `part` at material point `at` of `bodies[0]`, as the method shows it, Pa
    // constraint force on the particles of `bodies[0]` that are clamped, guided or driven, component `axis`, N
    static const Kind reaction;
    static const Kind contact_force;  // on `bodies[0]`, of `bodies[1]` or else of `wall`, component `axis`, N
    static const Kind expression;     // `value` of the probes before it
  };
  std::string name;
  Kind kind = Kind::displacement;
  std::vector<int> bodies;
  Point at{}, to{};
  int axis = 0;
  Point turns_about{0, 0, 1};  // direction of an axis through the origin, of length 1; z in 2D
  StressPart part{};
  Expression where;  // of a reaction: particles where it is not 0; empty = all
  int wall = -1;     // index into Scene::walls
  /// Of the values that the probes before this one have at a time, s.
  std::function<double(const std::vector<double>&, double)> value;
  bool of_forces = false;  // `value` is of forces alone
};

inline constexpr Probe::Kind Probe::Kind::displacement{"displacement"}, Probe::Kind::position{"position"},
    Probe::Kind::velocity{"velocity"}, Probe::Kind::distance{"distance"},
    Probe::Kind::mean_velocity{"mean_velocity"}, Probe::Kind::mean_position{"mean_position"},
    Probe::Kind::greatest_position{"greatest_position"}, Probe::Kind::gap{"gap"},
    Probe::Kind::mirror_asymmetry{"mirror_asymmetry"}, Probe::Kind::turn{"turn"},
    Probe::Kind::stress{"stress"}, Probe::Kind::reaction{"reaction", true},
    Probe::Kind::contact_force{"contact_force", true}, Probe::Kind::expression{"expression"};

/// Its samples are means over the steps before, and not values at their times.
inline bool is_of_steps(const Probe& probe) { return probe.kind.is_force || probe.of_forces; }

/// Points of a body, evenly spaced along a straight line, at which a field is sampled.
struct SampleLine {
  std::string name;
  int body = 0;           // index into Scene::bodies
  std::string field;      // its key
  Point from{}, to{};     // the first and the last point, m
  bool in_space = false;  // points that stand still while the body moves through them, else material ones
  int points = 0;
  std::vector<double> times;  // s, increasing
};

/// A number made from the series of probes, with its unit as it stands in run.json.
struct Measure {
  std::string name;
  std::string kind;                 // its name, see diagnostics/measure_kinds.hpp; what else counts it says
  std::vector<std::string> probes;  // those of a point: one for each axis
  std::string line;
  int body = 0;                     // index into Scene::bodies
  std::vector<std::string> fields;  // keys of the components of what is compared
  bool rigid_motion_free = false;   // of displacements: loads leave a small rigid motion open
  std::string unit;
  double threshold = 0;
  double scale = 1;
  std::array<double, 2> band{};  // Hz
  double about = 0;              // the level of a swing, the probe's unit
  bool about_mean = false;       // that level is the mean over whole periods
  double from = 0;               // s
  std::optional<double> until;   // s; none = the end of the run
  double time = 0;               // s
  std::string free;              // the probe that says that the bodies are apart; may be empty
  Point axis{0, 0, 1};           // of a turn in 3D, of length 1
};

/// A table of an independent solution: time and a column for each probe of a measure, or the distance from
/// the first point and a column for a line, linearly interpolated.
struct ReferenceTable {
  std::vector<double> t;                   // s, m
  std::vector<std::vector<double>> value;  // [probe], the probe's unit
};

/// Independent values for the measures of this very scene (the parameters as they stand), of one law.
struct Reference {
  std::string name;                       // "finite elements, 2d deviator, ..."; of several, all of them
  std::map<std::string, double> value{};  // measure → value in the measure's unit
  std::map<std::string, ReferenceTable> table{};
  std::map<std::string, std::vector<Solution>>
      solution{};  // measure → exact solution, [probe], of the line or [field]
  std::map<std::string, std::string>
      names{};  // measure → which of `name` it is compared with, where these are several

  bool has(const std::string& measure) const {
    return value.contains(measure) || table.contains(measure) || solution.contains(measure);
  }
  const std::string& name_for(const std::string& measure) const {
    const auto own = names.find(measure);
    return own == names.end() ? name : own->second;
  }
};

/// What is simulated. Plain data: every expression of a scene file has been evaluated or bound.
struct Scene {
  std::string name;
  std::string title;
  std::string source;
  int dim = 2;
  double spacing = 0;  // dp, m; divides the first body (see fitted_spacing)
  Jitter jitter;
  double until = 0;  // s
  std::vector<Material> materials;
  std::vector<Body> bodies;
  std::vector<Wall> walls;
  ContactLaw contact = ContactLaw::published;
  std::array<std::function<double(double)>, 3> gravity;  // m/s², of the time in s; empty = 0
  double damping =
      0;  // c, 1/s, of a viscous force −c m v: for scenes that come to rest; see solver/loads.hpp
  std::vector<Probe> probes;
  std::vector<SampleLine> lines;
  std::vector<Measure> measures;
  /// By deviator law ("2d_deviator", "neo_hookean"); empty where there is none for these parameters.
  std::map<std::string, Reference> references;
};

/// It lets its region go before the run is over; what ends with the run does not, as the last step ends a little later.
bool lets_go(const Drive& drive, const Scene& scene);
/// Index of the last of the regions that hold at x, the one that counts; −1: none.
template <class Region>
int last_that_holds(const std::vector<Region>& regions, const Point& x) {
  int k = static_cast<int>(regions.size()) - 1;
  while (k >= 0 && !(regions[k].where && regions[k].where(x) != 0)) --k;
  return k;
}
/// There are driven regions.
bool has_drives(const Scene& scene);
/// Some bodies start away from their reference configuration.
bool has_displacements(const Scene& scene);
bool starts_as_laid(const Body& body);
/// Where the particle of the body that stands at x in the reference configuration starts.
Point displaced(const Body& body, const Point& x);
/// Some particles are held along some axes.
bool has_guides(const Scene& scene);
bool has_gravity(const Scene& scene);
/// There are loads or there is gravity.
bool has_loads(const Scene& scene);

/// The spacing nearest to `spacing` that divides the thinnest extent of the first body's first shape into
/// whole particles, or rows of a hexagonal lattice; itself where the shape has no such extent.
double fitted_spacing(const Body& first, int dim, double spacing);

}  // namespace taut
