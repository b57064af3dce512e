#include "cli/drawing/staging.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/error.hpp"

namespace taut::cli {
namespace {

Point point(std::span<const double> of, int dim, std::size_t i) {
  const auto stride = static_cast<std::size_t>(dim);
  Point x{};
  for (std::size_t k = 0; k < stride; ++k) x[k] = of[stride * i + k];
  return x;
}

}  // namespace

FrameView StagedParticles::view() const {
  FrameView view;
  view.dim = dim;
  view.time = time;
  view.x = x;
  view.diameter = diameter;
  view.value = value;
  view.cell = cell;
  view.triangle = triangle;
  view.outline = outline, view.undeformed = undeformed;
  view.walls = walls;
  return view;
}

Staging::Staging(const Drawing& drawing, Origins origins)
    : origins_(std::move(origins)),
      walls_(drawing.walls),
      followed_(drawing.followed),
      shown_(origins_.size()),
      draws_surface_(drawing.style == Style::surface),
      has_categories_(!drawing.look.categories.empty()),
      outline_(drawing.outline) {
  std::iota(shown_.begin(), shown_.end(), std::size_t{0});
  std::erase_if(shown_,
                [&](std::size_t i) { return std::ranges::count(drawing.hidden, origins_.body[i]) > 0; });
  if (drawing.is_cut)
    std::erase_if(shown_,
                  [&](std::size_t i) { return drawing.is_cut(point(origins_.x0, origins_.dim, i)) != 0; });
  if (shown_.empty() && origins_.size() > 0)
    throw UsageError("cut = \"" + drawing.cut +
                     "\" hides all particles of the shown bodies; hide fewer, or reverse the expression");
  find_in_view();
  if (drawing.style == Style::cells) find_cells();
  if (drawing.scene) surface_.reset(new LazySurface{drawing.scene, drawing.is_cut});
}

/// Takes all shown particles if the followed body is hidden.
void Staging::find_in_view() {
  for (std::size_t k = 0; k < shown_.size(); ++k)
    if (!followed_ || origins_.body[shown_[k]] == *followed_) in_view_.push_back(k);
  if (!in_view_.empty()) return;
  in_view_.resize(shown_.size());
  std::iota(in_view_.begin(), in_view_.end(), std::size_t{0});
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

/// Drawing threads share the surface.
const Surface& Staging::surface() const {
  std::call_once(surface_->made,
                 [this] { surface_->surface.emplace(*surface_->scene, origins_, shown_, surface_->is_cut); });
  return *surface_->surface;
}

StagedParticles Staging::with_surface(StagedParticles staged) const {
  SurfaceShape shape = surface().at(staged.x, staged.value, has_categories_);
  if (draws(Outlines::deformed)) staged.outline = std::move(shape.outline);
  if (draws(Outlines::undeformed)) {
    staged.undeformed = surface().undeformed();
    for (std::size_t k = 0; k < staged.undeformed.size(); ++k) staged.undeformed[k] -= staged.origin[k % 2];
  }
  if (!draws_surface_) return staged;
  std::vector<double> diameter(shape.value.size(), 0);
  for (const std::uint32_t i : shape.loose) diameter[i] = staged.diameter[i];
  staged.x = std::move(shape.x), staged.value = std::move(shape.value);
  staged.triangle = std::move(shape.triangle), staged.diameter = std::move(diameter);
  return staged;
}

StagedParticles Staging::completed(StagedParticles staged) const {
  staged.walls = walls_;
  for (WallFace& wall : staged.walls)
    for (std::size_t k = 0; k < 3; ++k) wall.at[k] -= staged.origin[k];
  if (surface_) staged = with_surface(std::move(staged));
  if (!cells_) return staged;
  CellShapes shapes = cells_->at(staged.x);
  StagedParticles drawn{.dim = staged.dim,
                        .time = staged.time,
                        .x = std::move(shapes.centre),
                        .cell = std::move(shapes.edge),
                        .outline = std::move(staged.outline),
                        .undeformed = std::move(staged.undeformed),
                        .origin = staged.origin,
                        .walls = std::move(staged.walls)};
  for (const std::size_t k : shapes.particle) {
    drawn.diameter.push_back(staged.diameter[k]);
    drawn.value.push_back(staged.value[k]);
  }
  return drawn;
}

void Staging::extend(SequenceBounds& bounds, const StagedParticles& staged) const {
  const bool undeformed = draws(Outlines::undeformed);
  if (!followed_ && !undeformed) return bounds.add(staged.view());
  bounds.add_values(staged.value);
  std::vector<double> x;
  double diameter = 0;
  for (const std::size_t k : in_view_) {
    const Point at = point(staged.x, staged.dim, k);
    x.insert(x.end(), at.begin(), at.begin() + staged.dim);
    const Point initial = point(origins_.x0, staged.dim, shown_[k]);
    if (undeformed) x.insert(x.end(), {initial[0] - staged.origin[0], initial[1] - staged.origin[1]});
    diameter = std::max(diameter, staged.diameter[k]);
  }
  bounds.add_positions(x, staged.dim, diameter);
}

}  // namespace taut::cli
