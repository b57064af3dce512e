#include "engine/scene/shape.hpp"

#include <algorithm>

namespace taut {

Bounds joined(Bounds a, const Bounds& b) {
  for (std::size_t k = 0; k < a.low.size(); ++k)
    a.low[k] = std::min(a.low[k], b.low[k]), a.high[k] = std::max(a.high[k], b.high[k]);
  return a;
}

bool ShapeBase::has_exact_measure() const { return true; }
double ShapeBase::extent_to_divide(int) const { return 0; }
Point ShapeBase::middle() const { return bounds().middle(); }
Point ShapeBase::anchor() const { return bounds().low; }
std::vector<InitialSite> ShapeBase::sites(int, double) const { return {}; }
std::vector<Chain> ShapeBase::outline(int, double) const { return {}; }
std::vector<Chain> ShapeBase::outline_of_part(int dim, double dp, double) const { return outline(dim, dp); }
FacePatches ShapeBase::patches(double) const { return {}; }
Point ShapeBase::from_lattice(const Point& x) const { return x; }
Point ShapeBase::to_lattice(const Point& x) const { return x; }
Bounds ShapeBase::lattice_bounds() const { return bounds(); }

}  // namespace taut
