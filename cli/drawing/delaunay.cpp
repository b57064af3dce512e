#include "cli/drawing/delaunay.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace taut::cli {
namespace {

/// Irregular number from -1 to 1.
double scatter(std::size_t point, std::size_t axis) {
  constexpr std::array<double, 3> irrational{0.618033988749895, 0.414213562373095, 0.732050807568877};
  const double n = static_cast<double>(point + 1);
  return 2 * std::fmod(n * irrational[axis] + 0.25 * n * n * irrational[(axis + 1) % 3], 1.0) - 1;
}

struct Qhull {
  qhT state{};
  char* text = nullptr;
  std::size_t length = 0;
  std::FILE* messages = open_memstream(&text, &length);

  Qhull() { qh_zero(&state, messages); }
  ~Qhull() {
    qh_freeqhull(&state, qh_ALL);
    int blocks = 0, bytes = 0;
    qh_memfreeshort(&state, &blocks, &bytes);
    std::fclose(messages);
    std::free(text);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;
};

}  // namespace

std::vector<std::uint32_t> delaunay(int dim, std::span<const double> x) {
  const auto stride = static_cast<std::size_t>(dim);
  const std::size_t count = x.size() / stride;
  if (count <= stride) return {};
  std::vector<double> moved(x.begin(), x.end());
  for (std::size_t k = 0; k < moved.size(); ++k) moved[k] += 1e-4 * scatter(k / stride, k % stride);

  const auto qhull = std::make_unique<Qhull>();
  qhT* const qh = &qhull->state;
  std::string options = "qhull d Qbb Qt";
  if (qh_new_qhull(qh, dim, static_cast<int>(count), moved.data(), False, options.data(), nullptr,
                   qhull->messages) != 0) {
    std::fflush(qhull->messages);
    throw std::runtime_error("Qhull cannot triangulate the particles: " +
                             std::string(qhull->text, qhull->length));
  }
  std::vector<std::uint32_t> simplices;
  facetT* facet = nullptr;
  vertexT *vertex = nullptr, **vertexp = nullptr;
  FORALLfacets {
    if (facet->upperdelaunay || !facet->simplicial) continue;
    FOREACHvertex_(facet->vertices)
        simplices.push_back(static_cast<std::uint32_t>(qh_pointid(qh, vertex->point)));
  }
  return simplices;
}

}  // namespace taut::cli
