#include "engine/scene/initial_particles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "engine/error.hpp"

namespace taut {
namespace {

constexpr double edge_tolerance = 1e-6;  // of dp: a particle this close to an edge counts as inside

double measure_of_ball(int dim, double r) {
  return dim == 2 ? std::numbers::pi * r * r : 4.0 / 3.0 * std::numbers::pi * r * r * r;
}

struct Bounds {
  Point low, high;
};

Bounds bounds(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape)) return {box->low, box->high};
  const auto [centre, radius] = std::holds_alternative<Disc>(shape)
                                    ? std::pair{std::get<Disc>(shape).centre, std::get<Disc>(shape).radius}
                                    : std::pair{std::get<Ring>(shape).centre, std::get<Ring>(shape).outer};
  Bounds b{centre, centre};
  for (int k = 0; k < 3; ++k) b.low[k] -= radius, b.high[k] += radius;
  return b;
}

bool inside(const Shape& shape, const Point& x, int dim, double tolerance) {
  if (const auto* box = std::get_if<Box>(&shape)) {
    for (int k = 0; k < dim; ++k)
      if (x[k] < box->low[k] - tolerance || x[k] > box->high[k] + tolerance) return false;
    return true;
  }
  const auto distance = [&](const Point& centre) {
    double r2 = 0;
    for (int k = 0; k < dim; ++k) r2 += (x[k] - centre[k]) * (x[k] - centre[k]);
    return std::sqrt(r2);
  };
  if (const auto* disc = std::get_if<Disc>(&shape)) return distance(disc->centre) <= disc->radius + tolerance;
  const auto& ring = std::get<Ring>(shape);
  const double r = distance(ring.centre);
  return r >= ring.inner - tolerance && r <= ring.outer + tolerance;
}

/// About how many particles the shapes will hold; shapes of a union are counted each.
double expected_number(const Body& body, int dim, double dp) {
  double volume = 0;
  for (const Shape& shape : body.shapes) {
    if (const auto* box = std::get_if<Box>(&shape)) {
      double v = 1;
      for (int k = 0; k < dim; ++k) v *= std::max(0.0, box->high[k] - box->low[k]);
      volume += v;
    } else if (const auto* disc = std::get_if<Disc>(&shape)) {
      volume += measure_of_ball(dim, disc->radius);
    } else {
      const auto& ring = std::get<Ring>(shape);
      volume += measure_of_ball(dim, ring.outer) - measure_of_ball(dim, ring.inner);
    }
  }
  return volume / std::pow(dp, dim);
}

struct Site {
  Point x;
  double V0;
};

/// Particles at r = inner + (k + ½) dp, on each layer a whole number of them about dp apart, the first on the
/// positive x axis.
std::vector<Site> concentric_sites(const Ring& ring, double dp) {
  std::vector<Site> sites;
  const int layers = std::max(1L, std::lround((ring.outer - ring.inner) / dp));
  const double thickness = (ring.outer - ring.inner) / layers;
  for (int layer = 0; layer < layers; ++layer) {
    const double r = ring.inner + (layer + 0.5) * thickness;
    const long n = std::max(1L, std::lround(2 * std::numbers::pi * r / dp));
    const double V0 = 2 * std::numbers::pi * r * thickness / static_cast<double>(n);
    for (long k = 0; k < n; ++k) {
      // angles from −π to π, so that the layer is its own mirror image in y to the last bit
      const double angle =
          2 * std::numbers::pi * static_cast<double>(2 * k <= n ? k : k - n) / static_cast<double>(n);
      sites.push_back({{ring.centre[0] + r * std::cos(angle), ring.centre[1] + r * std::sin(angle), 0}, V0});
    }
  }
  return sites;
}

/// Square lattice of pitch dp over the union of the shapes. It is anchored half a pitch inside the low corner
/// of a box, half a pitch off the centre of anything round.
std::vector<Site> lattice_sites(const Body& body, int dim, double dp) {
  Point anchor{};
  if (const auto* box = std::get_if<Box>(&body.shapes.front())) {
    anchor = box->low;
  } else {
    const Bounds b = bounds(body.shapes.front());
    for (int k = 0; k < 3; ++k) anchor[k] = 0.5 * (b.low[k] + b.high[k]);
  }
  Bounds all = bounds(body.shapes.front());
  for (const Shape& shape : body.shapes) {
    const Bounds b = bounds(shape);
    for (int k = 0; k < 3; ++k)
      all.low[k] = std::min(all.low[k], b.low[k]), all.high[k] = std::max(all.high[k], b.high[k]);
  }
  long from[3] = {0, 0, 0}, to[3] = {0, 0, 0};
  for (int k = 0; k < dim; ++k) {
    from[k] = static_cast<long>(std::floor((all.low[k] - anchor[k]) / dp)) - 1;
    to[k] = static_cast<long>(std::ceil((all.high[k] - anchor[k]) / dp)) + 1;
  }
  std::vector<Site> sites;
  const double V0 = std::pow(dp, dim);
  for (long k = from[2]; k <= to[2]; ++k) {
    for (long j = from[1]; j <= to[1]; ++j) {
      for (long i = from[0]; i <= to[0]; ++i) {
        Point x{anchor[0] + (static_cast<double>(i) + 0.5) * dp,
                anchor[1] + (static_cast<double>(j) + 0.5) * dp, 0};
        if (dim == 3) x[2] = anchor[2] + (static_cast<double>(k) + 0.5) * dp;
        const auto holds = [&](const Shape& s) { return inside(s, x, dim, edge_tolerance * dp); };
        if (std::any_of(body.shapes.begin(), body.shapes.end(), holds)) sites.push_back({x, V0});
      }
    }
  }
  return sites;
}

double twice_centre(const Shape& shape, int k) {
  if (const auto* box = std::get_if<Box>(&shape)) return box->low[k] + box->high[k];
  if (const auto* disc = std::get_if<Disc>(&shape)) return 2 * disc->centre[k];
  return 2 * std::get<Ring>(shape).centre[k];
}

void shift(Shape& shape, int k, double by) {
  if (auto* box = std::get_if<Box>(&shape)) {
    box->low[k] += by;
    box->high[k] += by;
  } else if (auto* disc = std::get_if<Disc>(&shape)) {
    disc->centre[k] += by;
  } else {
    std::get<Ring>(shape).centre[k] += by;
  }
}

/// A reflected layout about c is one about −c with the sign of its coordinates changed: the image of a round
/// body at −c to the last bit.
std::vector<Site> body_sites(Body body, int dim, double dp) {
  for (int k = 0; k < dim; ++k) {
    if (!body.mirror[k]) continue;
    const double by = -twice_centre(body.shapes.front(), k);
    for (Shape& shape : body.shapes) shift(shape, k, by);
  }
  const auto* ring = std::get_if<Ring>(&body.shapes.front());
  std::vector<Site> sites = ring && body.shapes.size() == 1 && dim == 2 ? concentric_sites(*ring, dp)
                                                                        : lattice_sites(body, dim, dp);
  for (int k = 0; k < dim; ++k)
    if (body.mirror[k])
      for (Site& site : sites) site.x[k] = -site.x[k];
  return sites;
}

double value_of(const Expression& f, const Point& x) { return f ? f(x) : 0; }

/// Index of the last of the regions that hold at x, or -1.
template <class Region>
int last_that_holds(const std::vector<Region>& regions, const Point& x) {
  int k = static_cast<int>(regions.size()) - 1;
  while (k >= 0 && value_of(regions[k].where, x) == 0) --k;
  return k;
}

/// A region without particles is a slip of whoever wrote it.
template <class Region>
void refuse_empty(const std::vector<Region>& regions, const std::vector<Site>& sites, const Body& body,
                  const std::string& key) {
  for (std::size_t k = 0; k < regions.size(); ++k) {
    const auto holds = [&](const Site& site) { return value_of(regions[k].where, site.x) != 0; };
    if (std::ranges::none_of(sites, holds))
      throw SceneError("body." + body.name + "." + key, key + ": no particle of body '" + body.name +
                                                            "' is in region " + std::to_string(k + 1) +
                                                            ": its 'where' is 0 at all of them");
  }
}

void append(InitialParticles& layout, const Scene& scene, int b) {
  const Body& body = scene.bodies[b];
  const std::vector<Site> sites = body_sites(body, scene.dim, scene.spacing);
  if (sites.empty())
    throw SceneError("body." + body.name, "body '" + body.name +
                                              "' holds no particle: its shapes are smaller than the spacing; "
                                              "choose a smaller spacing");
  refuse_empty(body.parts, sites, body, "parts");
  refuse_empty(body.drives, sites, body, "driven");
  refuse_empty(body.loads, sites, body, "loaded");
  for (const Site& site : sites) {
    layout.x.push_back(site.x);
    layout.V0.push_back(site.V0);
    layout.body.push_back(b);
    const int part = last_that_holds(body.parts, site.x);
    layout.material.push_back(part < 0 ? body.material : body.parts[part].material);
    layout.drive.push_back(last_that_holds(body.drives, site.x));
    layout.held.push_back(value_of(body.held, site.x) != 0);
    if (layout.held.back() && layout.drive.back() >= 0)
      throw SceneError("body." + body.name + ".driven",
                       "particles of body '" + body.name +
                           "' are both held and driven; let 'held' and the 'where' of 'driven' not overlap");
    Point v{};
    if (!layout.held.back())
      for (int k = 0; k < scene.dim; ++k) v[k] = value_of(body.velocity[k], site.x);
    layout.v.push_back(v);
  }
  layout.first.push_back(layout.size());
}

/// Particles of two bodies closer than half a spacing are an overlap: contact could not part them.
void refuse_overlap(const InitialParticles& layout, const Scene& scene) {
  if (scene.bodies.size() < 2) return;
  const double reach = 0.5 * scene.spacing;
  const auto cell = [&](double x) { return static_cast<long>(std::floor(x / reach)); };
  const auto key = [](long i, long j, long k) {
    return static_cast<std::size_t>(i) * 73856093u ^ static_cast<std::size_t>(j) * 19349663u ^
           static_cast<std::size_t>(k) * 83492791u;
  };
  std::unordered_multimap<std::size_t, int> grid;
  for (int i = 0; i < layout.size(); ++i) {
    const Point& x = layout.x[i];
    const long c[3] = {cell(x[0]), cell(x[1]), cell(x[2])};
    const long depth = scene.dim == 3 ? 1 : 0;
    for (long dz = -depth; dz <= depth; ++dz) {
      for (long dy = -1; dy <= 1; ++dy) {
        for (long dx = -1; dx <= 1; ++dx) {
          const auto [begin, end] = grid.equal_range(key(c[0] + dx, c[1] + dy, c[2] + dz));
          for (auto it = begin; it != end; ++it) {
            const int j = it->second;
            if (layout.body[i] == layout.body[j]) continue;
            double r2 = 0;
            for (int k = 0; k < 3; ++k) r2 += (x[k] - layout.x[j][k]) * (x[k] - layout.x[j][k]);
            if (r2 >= reach * reach) continue;
            const std::string &a = scene.bodies[layout.body[i]].name, &b = scene.bodies[layout.body[j]].name;
            throw SceneError("body." + a, "bodies '" + a + "' and '" + b +
                                              "' overlap: two of their particles are " +
                                              std::to_string(std::sqrt(r2) / scene.spacing) +
                                              " spacings apart, at least 0.5 are needed; move one of them");
          }
        }
      }
    }
    grid.emplace(key(c[0], c[1], c[2]), i);
  }
}

}  // namespace

double Material::sound_speed() const { return std::sqrt(bulk_modulus() / density); }

bool has_drives(const Scene& scene) {
  return std::ranges::any_of(scene.bodies, [](const Body& body) { return !body.drives.empty(); });
}

bool has_gravity(const Scene& scene) {
  return std::ranges::any_of(scene.gravity, [](const auto& component) { return component != nullptr; });
}

bool has_loads(const Scene& scene) {
  return has_gravity(scene) ||
         std::ranges::any_of(scene.bodies, [](const Body& body) { return !body.loads.empty(); });
}

std::string_view name(Load::Kind kind) {
  constexpr std::string_view names[] = {"force", "force_density", "traction"};
  return names[static_cast<int>(kind)];
}

std::string_view name(ContactLaw law) {
  constexpr std::string_view names[] = {"published", "sph", "impulse", "penalty", "lennard-jones"};
  return names[static_cast<int>(law)];
}

double fitted_spacing(const Body& first, int dim, double spacing) {
  double extent = 0;
  const Shape& shape = first.shapes.front();
  if (const auto* box = std::get_if<Box>(&shape)) {
    extent = box->high[0] - box->low[0];
    for (int k = 1; k < dim; ++k) extent = std::min(extent, box->high[k] - box->low[k]);
  } else if (const auto* disc = std::get_if<Disc>(&shape)) {
    extent = 2 * disc->radius;
  } else {
    const auto& ring = std::get<Ring>(shape);
    extent = ring.outer - ring.inner;
  }
  const double fitted = extent / std::max(1.0, std::round(extent / spacing));
  return std::abs(fitted - spacing) <= 1e-9 * spacing ? spacing : fitted;  // 0.04 − 0.03 is not quite 0.01
}

InitialParticles make_initial_particles(const Scene& scene) {
  double expected = 0;
  for (const Body& body : scene.bodies) expected += expected_number(body, scene.dim, scene.spacing);
  if (!(expected <= greatest_particle_number))
    throw SceneError("spacing", "a spacing of " + std::to_string(scene.spacing) + " m would make about " +
                                    std::to_string(expected / 1e6) +
                                    " million particles; at most 20 million are allowed");
  InitialParticles layout;
  layout.dim = scene.dim;
  layout.first.push_back(0);
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b) append(layout, scene, b);
  if (layout.size() == 0) throw SceneError("body", "the scene has no particles; add a [[body]]");
  refuse_overlap(layout, scene);
  return layout;
}

}  // namespace taut
