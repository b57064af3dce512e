#include "engine/layout/initial_particles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <span>

#include <fmt/core.h>
#include <fmt/format.h>

#include "engine/core/index.hpp"
#include "engine/error.hpp"
#include "engine/layout/element_nodes.hpp"
#include "engine/layout/overlap.hpp"
#include "engine/layout/relaxation.hpp"
#include "engine/scene/shapes/box.hpp"

namespace taut {
namespace {

constexpr double edge_tolerance = 1e-6;  // in dp
constexpr double greatest_place_number = 1e9;

/// Estimate from the measures of the shapes; too great if shapes overlap, are cut or have no exact measure.
double expected_number(const Body& body, int dim, double dp) {
  double volume = 0;
  for (const Shape& shape : body.shapes) volume += shape->measure(dim);
  return volume / std::pow(dp, dim);
}

bool has_exact_number(const Body& body) {
  return body.shapes.size() == 1 && body.without.empty() && body.shapes.front()->has_exact_measure();
}

std::size_t first_that_holds(const std::vector<Shape>& shapes, const Point& x, int dim, double tolerance) {
  const auto found =
      std::ranges::find_if(shapes, [&](const Shape& s) { return s->holds(x, dim, tolerance); });
  return static_cast<std::size_t>(found - shapes.begin());
}

Bounds lattice_bounds_of(const Body& body) {
  const Shape& first = body.shapes.front();
  Bounds all = first->lattice_bounds();
  for (const Shape& shape : std::span(body.shapes).subspan(1))
    all =
        joined(all, bounds_of_placed(shape->bounds(), [&](const Point& x) { return first->to_lattice(x); }));
  return all;
}

void check_cuts(const Body& body, const std::vector<long>& cut) {
  for (std::size_t k = 0; k < cut.size(); ++k)
    if (cut[k] == 0)
      throw SceneError(fmt::format("body.{}.without", body.name),
                       fmt::format("without: shape {} removes no particle of body '{}'; correct or remove it",
                                   k + 1, body.name));
}

struct LatticeRows {
  Point anchor{};
  std::array<double, 3> pitch{};
  std::array<long, 3> from{}, to{};
  std::size_t along = 0;  // axis of hexagonal rows
  double staggered = 0;   // shift of hexagonal rows, alternately + and −, in pitches

  Point at(long i, long j, long k, int dim) const {
    const std::array<long, 3> n{i, j, k};
    Point x{};
    for (std::size_t a = 0; a < static_cast<std::size_t>(dim); ++a)
      x[a] = anchor[a] + (static_cast<double>(n[a]) + 0.5) * pitch[a];
    if (staggered > 0) x[along] += (n[1 - along] % 2 == 0 ? staggered : -staggered) * pitch[along];
    return x;
  }
};

LatticeRows rows_of(const Body& body, int dim, double dp) {
  LatticeRows rows{.anchor = body.shapes.front()->anchor()};
  rows.pitch = {dp, dp, dp};
  const Bounds all = lattice_bounds_of(body);
  if (body.lattice == Lattice::hexagonal) {
    const Bounds first = body.shapes.front()->lattice_bounds();
    rows.along = first.high[0] - first.low[0] >= first.high[1] - first.low[1] ? 0 : 1;
    rows.staggered = 0.25;
    rows.pitch[rows.along] = dp / hexagonal_row;
    rows.pitch[1 - rows.along] = dp * hexagonal_row;
  }
  double places = 1;
  for (std::size_t k = 0; k < static_cast<std::size_t>(dim); ++k) {
    const double low = std::floor((all.low[k] - rows.anchor[k]) / rows.pitch[k]) - 1;
    const double high = std::ceil((all.high[k] - rows.anchor[k]) / rows.pitch[k]) + 1;
    places *= high - low + 1;
    if (!(places <= greatest_place_number))
      throw SceneError("body." + body.name,
                       fmt::format("the box around body '{}' has more than {:g} lattice sites; "
                                   "use a larger spacing, or make distant parts separate bodies",
                                   body.name, greatest_place_number));
    rows.from[k] = static_cast<long>(low);
    rows.to[k] = static_cast<long>(high);
  }
  return rows;
}

/// Calls f(x, cut) for each site in the shapes until it returns false. `cut`: the first cut-out that holds the site, or
/// the number of cut-outs.
template <class F>
void for_each_site(const Body& body, int dim, double dp, double tolerance, const F& f) {
  const LatticeRows rows = rows_of(body, dim, dp);
  for (long k = rows.from[2]; k <= rows.to[2]; ++k) {
    for (long j = rows.from[1]; j <= rows.to[1]; ++j) {
      for (long i = rows.from[0]; i <= rows.to[0]; ++i) {
        const Point x = body.shapes.front()->from_lattice(rows.at(i, j, k, dim));
        if (first_that_holds(body.shapes, x, dim, tolerance) == body.shapes.size()) continue;
        if (!f(x, first_that_holds(body.without, x, dim, -tolerance))) return;
      }
    }
  }
}

}  // namespace

std::vector<InitialSite> lattice_sites(const Body& body, int dim, double dp) {
  std::vector<InitialSite> sites;
  std::vector<long> cut(body.without.size());
  const double V0 = std::pow(dp, dim);
  for_each_site(body, dim, dp, edge_tolerance * dp, [&](const Point& x, std::size_t out) {
    if (out == body.without.size())
      sites.push_back({.x = x, .V0 = V0});
    else
      ++cut[out];
    return true;
  });
  check_cuts(body, cut);
  return sites;
}

namespace {

/// V0 is the part of the cell inside the box.
std::vector<InitialSite> sites_on_boundary(const Box& box, int dim, double dp) {
  long last[3] = {0, 0, 0};
  double pitch[3] = {1, 1, 1};
  for (int k = 0; k < dim; ++k) {
    last[k] = box.cells(k, dp);
    pitch[k] = (box.high[k] - box.low[k]) / static_cast<double>(last[k]);
  }
  std::vector<InitialSite> sites;
  for (long k = 0; k <= last[2]; ++k) {
    for (long j = 0; j <= last[1]; ++j) {
      for (long i = 0; i <= last[0]; ++i) {
        const long at[3] = {i, j, k};
        InitialSite site{.V0 = 1};
        for (int a = 0; a < dim; ++a) {
          const bool on_face = at[a] == 0 || at[a] == last[a];
          site.x[a] = at[a] == last[a] ? box.high[a] : box.low[a] + static_cast<double>(at[a]) * pitch[a];
          site.V0 *= on_face ? 0.5 * pitch[a] : pitch[a];
          if (on_face) site.inside *= 0.5;
          site.on_face[as_index(a)] = on_face;
        }
        sites.push_back(site);
      }
    }
  }
  return sites;
}

std::vector<InitialSite> own_sites(const Body& body, int dim, double dp) {
  if (body.shapes.size() != 1 || !body.without.empty() || body.relaxed) return {};
  if (body.on_boundary) return sites_on_boundary(*body.shapes.front().as<Box>(), dim, dp);
  return body.shapes.front()->sites(dim, dp);
}

/// Jitters along the lattice axes. Random numbers are the same with every compiler.
void jitter_sites(std::vector<InitialSite>& sites, const Jitter& jitter, const Shape& first, int dim,
                  double dp) {
  if (jitter.share == 0) return;
  std::mt19937_64 random(static_cast<std::uint64_t>(jitter.seed));
  for (InitialSite& site : sites) {
    site.turned = -1;
    Point x = first->to_lattice(site.x);
    for (std::size_t k = 0; k < as_index(dim); ++k) {
      const double even = 2 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1;
      if (!site.on_face[k]) x[k] += even * jitter.share * dp;
    }
    site.x = first->from_lattice(x);
  }
}

/// Reflects after the layout, so that mirrored bodies are exact images.
std::vector<InitialSite> body_sites(const Body& as_given, const Scene& scene) {
  const int dim = scene.dim;
  const Body body = unplaced_body(as_given, dim);
  std::vector<InitialSite> sites = own_sites(body, dim, scene.spacing);
  if (sites.empty()) sites = lattice_sites(body, dim, scene.spacing);
  if (body.relaxed) relax(sites, body, lattice_bounds_of(body), dim, scene.spacing);
  for (InitialSite& site : sites) site.middle = placed(as_given, site.x, dim);
  jitter_sites(sites, scene.jitter, body.shapes.front(), dim, scene.spacing);
  for (InitialSite& site : sites) site.x = placed(as_given, site.x, dim);
  return sites;
}

double value_of(const Expression& f, const Point& x) { return f ? f(x) : 0; }

template <class Region>
void refuse_empty(const std::vector<Region>& regions, const std::vector<InitialSite>& sites, const Body& body,
                  const std::string& key) {
  for (std::size_t k = 0; k < regions.size(); ++k) {
    const auto holds = [&](const InitialSite& site) { return value_of(regions[k].where, site.middle) != 0; };
    if (std::ranges::none_of(sites, holds))
      throw SceneError(
          fmt::format("body.{}.{}", body.name, key),
          fmt::format("{}: no particle of body '{}' is in region {}: its 'where' is 0 at all particles", key,
                      body.name, k + 1));
  }
}

void refuse_idle_hold(const Body& body, const std::vector<InitialSite>& sites) {
  const auto is_idle = [&](const Expression& where) {
    return where &&
           std::ranges::none_of(sites, [&](const InitialSite& site) { return where(site.middle) != 0; });
  };
  const auto refuse = [&](const std::string& what) {
    throw SceneError(
        fmt::format("body.{}.held", body.name),
        fmt::format(
            "{}: no particle of body '{}' is held: its value is 0 at all particles; to hold none, omit it or write 0",
            what, body.name));
  };
  for (std::size_t k = 0; k < body.guided.size(); ++k)
    if (is_idle(body.guided[k])) refuse(fmt::format("held[{}]", k));
  const bool by_component =
      std::ranges::any_of(body.guided, [](const Expression& e) { return e != nullptr; });
  if (!by_component && is_idle(body.clamped)) refuse("held");
}

/// Weights of n + 1 particles along n cells, in cells. An end that is not `free` counts as a plane of symmetry.
std::vector<double> shares_along(long n, const bool (&free)[2]) {
  std::vector<double> share(static_cast<std::size_t>(n) + 1, 1.0);
  share.front() = share.back() = 0.5;
  const double across = static_cast<double>(free[0] && free[1] ? n : 2 * n);
  const double inwards = across > 1 ? across / (12 * (across - 1)) : 0;
  if (free[0]) share[0] -= inwards, share[1] += inwards;
  if (free[1]) share[share.size() - 1] -= inwards, share[share.size() - 2] += inwards;
  return share;
}

unsigned char guide_at(const Body& body, const Point& x) {
  unsigned guide = 0;
  for (unsigned k = 0; k < body.guided.size(); ++k)
    if (value_of(body.guided[k], x) != 0) guide |= 1u << k;
  return static_cast<unsigned char>(guide);
}

/// Whether a face has unclamped particles, all guided along its normal or along all other axes.
template <class OnFace>
bool may_mirror(const InitialParticles& layout, int first, int axis, int dim, const OnFace& on_face) {
  const unsigned normal = 1u << axis, others = ((1u << dim) - 1) & ~normal;
  bool guided = false;
  for (int i = first; i < layout.size(); ++i) {
    if (!on_face(i - first) || layout.clamped[i]) continue;
    const unsigned guide = layout.guided[i];
    if ((guide & normal) == 0 && (guide & others) != others) return false;
    guided = true;
  }
  return guided;
}

void weigh_box(InitialParticles& layout, const Body& body, int first, int dim, double dp) {
  const Box& box = *body.shapes.front().as<Box>();
  long stride = 1;
  for (int axis = 0; axis < dim; ++axis) {
    const long n = box.cells(axis, dp);
    const auto number = [=](long i) { return i / stride % (n + 1); };
    bool free[2];
    for (const long end : {0L, 1L})
      free[end] = body.rotation ||
                  !may_mirror(layout, first, axis, dim, [&](long i) { return number(i) == end * n; });
    const std::vector<double> share = shares_along(n, free);
    for (int i = first; i < layout.size(); ++i) {
      const long k = number(i - first);
      const double change = share[static_cast<std::size_t>(k)] / (k == 0 || k == n ? 0.5 : 1);
      layout.V0[i] *= change, layout.inside[i] *= change;
    }
    stride *= n + 1;
  }
}

std::string reason_for_no_particle(const Body& body) {
  if (!body.without.empty())
    return "the rest of its shapes after 'without' is empty or thinner than the spacing; "
           "choose a smaller spacing or smaller cut-outs";
  if (std::ranges::all_of(body.shapes, [](const Shape& shape) { return shape->has_exact_measure(); }))
    return "its shapes are smaller than the spacing; choose a smaller spacing";
  return "its shapes are empty or thinner than the spacing; correct them or choose a smaller spacing";
}

void check_sites(const Body& body, const std::vector<InitialSite>& sites) {
  if (sites.empty())
    throw SceneError("body." + body.name, fmt::format("body '{}' contains no particle: {}", body.name,
                                                      reason_for_no_particle(body)));
  refuse_idle_hold(body, sites);
  refuse_empty(body.parts, sites, body, "parts");
  refuse_empty(body.drives, sites, body, "driven");
  refuse_empty(body.loads, sites, body, "loaded");
  const auto is_traction = [](const Load& load) { return load.kind == Load::Kind::traction; };
  if (body.on_boundary && std::ranges::any_of(body.loads, is_traction))
    throw SceneError(
        fmt::format("body.{}.loaded", body.name),
        fmt::format("a traction cannot act on body '{}', whose particles are on its faces (on_boundary): "
                    "give the total force as 'force'",
                    body.name));
}

void append(InitialParticles& layout, const Scene& scene, int b) {
  const Body& body = scene.bodies[b];
  const std::vector<InitialSite> sites = body_sites(body, scene);
  check_sites(body, sites);
  const int first = layout.size();
  for (const InitialSite& site : sites) {
    layout.turned.push_back(site.turned < 0 ? layout.size() : first + site.turned);
    layout.V0.push_back(site.V0);
    layout.inside.push_back(site.inside);
    layout.body.push_back(b);
    const int part = last_that_holds(body.parts, site.middle);
    layout.material.push_back(part < 0 ? body.material : body.parts[part].material);
    const int drive = last_that_holds(body.drives, site.middle);
    layout.drive.push_back(drive);
    const bool clamped = value_of(body.clamped, site.middle) != 0;
    layout.clamped.push_back(clamped);
    if (clamped && drive >= 0)
      throw SceneError(
          fmt::format("body.{}.driven", body.name),
          fmt::format(
              "particles of body '{}' are both held and driven; 'held' and the 'where' of 'driven' must not overlap",
              body.name));
    layout.guided.push_back(clamped ? 0 : guide_at(body, site.middle));
    const auto is_free = [&](int k) { return !clamped && (layout.guided.back() >> k & 1) == 0; };
    // jitter would move guided particles off a rotated face
    const bool stays = drive >= 0 || (body.rotation && layout.guided.back() != 0);
    Point x = site.x, v{};
    for (int k = 0; k < scene.dim; ++k)
      if (!is_free(k) || stays) x[k] = site.middle[k];
    for (int k = 0; k < scene.dim; ++k)
      if (is_free(k)) v[k] = value_of(body.velocity[k], x);
    layout.x.push_back(x);
    if (scene.jitter.share > 0) layout.middle.push_back(site.middle);
    layout.v.push_back(v);
  }
  layout.first.push_back(layout.size());
  const bool on_lattice =
      std::ranges::adjacent_find(sites, std::ranges::not_equal_to(), &InitialSite::V0) == sites.end();
  layout.relaxed.push_back(body.relaxed && !on_lattice);
  if (body.on_boundary) weigh_box(layout, body, first, scene.dim, scene.spacing);
}

/// Counts particles if their estimated number exceeds the limit; without tolerance, which makes expressions slow.
void refuse_too_many(const Scene& scene) {
  const auto refuse = [&](const std::string& number) {
    throw SceneError("spacing", fmt::format("a spacing of {:g} m would make {} million particles; "
                                            "at most 20 million are allowed",
                                            scene.spacing, number));
  };
  double number = 0, bound = 0;
  for (const Body& body : scene.bodies) {
    const double expected = expected_number(body, scene.dim, scene.spacing);
    (has_exact_number(body) ? number : bound) += expected;
  }
  if (!(number <= greatest_particle_number)) refuse(fmt::format("about {:g}", number / 1e6));
  if (number + bound <= greatest_particle_number) return;
  for (const Body& body : scene.bodies) {
    if (has_exact_number(body)) continue;
    const Body laid = unplaced_body(body, scene.dim);
    for_each_site(laid, scene.dim, scene.spacing, 0, [&](const Point&, std::size_t out) {
      number += out == laid.without.size();
      return number <= greatest_particle_number;
    });
    if (number > greatest_particle_number) refuse("more than 20");
  }
}

}  // namespace

InitialParticles make_initial_particles(const Scene& scene) {
  refuse_too_many(scene);
  if (scene.element_order > 0) return make_element_nodes(scene);
  InitialParticles layout;
  layout.dim = scene.dim;
  layout.first.push_back(0);
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b) append(layout, scene, b);
  if (layout.size() == 0) throw SceneError("body", "the scene has no particles; add a [[body]]");
  if (has_displacements(scene))
    for (int i = 0; i < layout.size(); ++i)
      layout.start.push_back(displaced(scene.bodies[layout.body[i]], layout.x[i]));
  if (std::ranges::count(layout.guided, 0) == layout.size()) layout.guided.clear();
  refuse_overlap(layout, scene);
  return layout;
}

}  // namespace taut
