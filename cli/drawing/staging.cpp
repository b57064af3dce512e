#include "cli/drawing/staging.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/error.hpp"
#include "engine/layout/initial_particles.hpp"

namespace taut::cli {
namespace {

Point point(std::span<const double> of, int dim, std::size_t i) {
  const auto stride = static_cast<std::size_t>(dim);
  Point x{};
  for (std::size_t k = 0; k < stride; ++k) x[k] = of[stride * i + k];
  return x;
}

}  // namespace

Origins origins_of(const Snapshot& snapshot) {
  return {snapshot.dim, snapshot.x0, snapshot.m, snapshot.diameter, snapshot.body};
}

Origins origins_of(const Scene& scene) {
  const InitialParticles particles = make_initial_particles(scene);
  Origins origins{scene.dim, {}, {}, {}, particles.body};
  for (std::size_t i = 0; i < particles.V0.size(); ++i) {
    const Point& x = particles.x[i];
    origins.x0.insert(origins.x0.end(), x.begin(), x.begin() + scene.dim);
    const auto material = static_cast<std::size_t>(particles.material[i]);
    origins.diameter.push_back(std::pow(particles.V0[i], 1.0 / scene.dim));
    origins.m.push_back(scene.materials[material].density * particles.V0[i]);
  }
  return origins;
}

FrameView StagedParticles::view() const {
  FrameView view;
  view.dim = dim;
  view.time = time;
  view.x = x;
  view.diameter = diameter;
  view.value = value;
  view.cell = cell;
  view.walls = walls;
  return view;
}

Staging::Staging(const Drawing& drawing, Origins origins)
    : origins_(std::move(origins)),
      walls_(drawing.walls),
      followed_(drawing.followed),
      shown_(origins_.size()) {
  std::iota(shown_.begin(), shown_.end(), std::size_t{0});
  if (drawing.is_cut)
    std::erase_if(shown_,
                  [&](std::size_t i) { return drawing.is_cut(point(origins_.x0, origins_.dim, i)) != 0; });
  if (shown_.empty() && origins_.size() > 0)
    throw UsageError("cut = \"" + drawing.cut +
                     "\" hides all particles: it is true at every initial position; "
                     "hide fewer, or reverse the expression");
  if (drawing.style == Style::cells) find_cells();
}

void Staging::find_cells() {
  std::vector<double> x0, diameter;
  std::vector<int> body;
  for (const std::size_t i : shown_) {
    const Point x = point(origins_.x0, origins_.dim, i);
    x0.insert(x0.end(), x.begin(), x.begin() + origins_.dim);
    diameter.push_back(origins_.diameter[i]);
    body.push_back(origins_.body[i]);
  }
  cells_.emplace(origins_.dim, x0, diameter, body);
  if (shown_.size() < origins_.size())
    cells_->take_ends(Cells(origins_.dim, origins_.x0, origins_.diameter, origins_.body), shown_);
}

Point Staging::middle(const FrameView& particles) const {
  Point sum{};
  double mass = 0;
  for (std::size_t i = 0; i < origins_.size(); ++i) {
    if (origins_.body[i] != *followed_) continue;
    const Point x = point(particles.x, particles.dim, i);
    for (std::size_t k = 0; k < x.size(); ++k) sum[k] += origins_.m[i] * x[k];
    mass += origins_.m[i];
  }
  for (double& component : sum) component /= mass;
  return sum;
}

StagedParticles Staging::operator()(const FrameView& particles) const {
  if (particles.value.size() != origins_.size())
    throw UsageError("the particles do not belong to the scene: there are " +
                     std::to_string(particles.value.size()) + ", but the scene has " +
                     std::to_string(origins_.size()));
  const Point origin = followed_ ? middle(particles) : Point{};
  StagedParticles staged{.dim = particles.dim, .time = particles.time, .origin = origin};
  staged.x.reserve(shown_.size() * static_cast<std::size_t>(particles.dim));
  staged.value.reserve(shown_.size());
  for (const std::size_t i : shown_) {
    const Point x = point(particles.x, particles.dim, i);
    for (std::size_t k = 0; k < static_cast<std::size_t>(particles.dim); ++k)
      staged.x.push_back(x[k] - origin[k]);
    staged.diameter.push_back(particles.diameter[i]);
    staged.value.push_back(particles.value[i]);
  }
  return staged;
}

StagedParticles Staging::with_cells_and_walls(StagedParticles staged) const {
  staged.walls = walls_;
  for (WallFace& wall : staged.walls)
    for (std::size_t k = 0; k < 3; ++k) wall.at[k] -= staged.origin[k];
  if (!cells_) return staged;
  CellShapes shapes = cells_->at(staged.x);
  StagedParticles drawn{.dim = staged.dim,
                        .time = staged.time,
                        .x = std::move(shapes.centre),
                        .cell = std::move(shapes.edge),
                        .origin = staged.origin,
                        .walls = std::move(staged.walls)};
  for (const std::size_t k : shapes.particle) {
    drawn.diameter.push_back(staged.diameter[k]);
    drawn.value.push_back(staged.value[k]);
  }
  return drawn;
}

void Staging::extend(SequenceBounds& bounds, const StagedParticles& staged) const {
  FrameView view = staged.view();
  if (!followed_) return bounds.add(view);
  bounds.add_values(view.value);
  std::vector<double> x;
  double diameter = 0;
  for (std::size_t k = 0; k < shown_.size(); ++k) {
    if (origins_.body[shown_[k]] != *followed_) continue;
    const Point at = point(view.x, view.dim, k);
    x.insert(x.end(), at.begin(), at.begin() + view.dim);
    diameter = std::max(diameter, view.diameter[k]);
  }
  bounds.add_positions(x, view.dim, diameter);
}

}  // namespace taut::cli
