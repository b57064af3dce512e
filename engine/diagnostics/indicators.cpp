#include "engine/diagnostics/indicators.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/diagnostics/deviator.hpp"

namespace taut {
namespace {

constexpr double least_strain = 1e-8;  // over Young's modulus: stress of round-off

/// Two doubles that any x86-64 works on at once; wider ones would be split up, slowly.
constexpr int lanes = 2;
typedef double Pair __attribute__((vector_size(lanes * sizeof(double))));

/// A row of the table: x, p, s, and zeros up to whole pairs.
template <int Dim>
struct Row {
  static constexpr int p = Dim, s = Dim + 1, stored = Dim == 3 ? 6 : 4;
  static constexpr int pairs = (s + stored + lanes - 1) / lanes, width = pairs * lanes;
};

template <int Dim>
void fill(std::vector<double>& table, const Snapshot& now) {
  using R = Row<Dim>;
  table.resize(now.size() * R::width);
  for (std::size_t i = 0; i < now.size(); ++i) {
    double* row = table.data() + i * R::width;
    const Point x = now.position(i);
    std::copy_n(x.begin(), Dim, row);
    row[R::p] = now.p[i];
    std::ranges::copy(deviator(now, i), row + R::s);
  }
}

/// Σ_j w_ij q_j of a row of the weights, for all fields.
template <int Dim>
std::array<double, Row<Dim>::width> filtered(const AlternatingPart& part, int row, const double* table) {
  using R = Row<Dim>;
  Pair sum[R::pairs] = {};
  const double* weight = part.weights(row);
  for (int k = part.begin[row]; k < part.begin[row + 1]; ++k, ++weight) {
    Pair q[R::pairs];
    std::memcpy(q, table + std::ptrdiff_t{part.j[k]} * R::width, sizeof q);
    for (int a = 0; a < R::pairs; ++a) sum[a] += *weight * q[a];
  }
  std::array<double, R::width> r;
  std::memcpy(r.data(), sum, sizeof sum);
  return r;
}

/// Squares of a row: |x|² in m², p² and 3/2 s:s in Pa².
struct Squares {
  double x = 0, p = 0, von_mises = 0;
};

template <int Dim>
Squares squares(const double* row) {
  using R = Row<Dim>;
  Squares sum;
  for (int a = 0; a < Dim; ++a) sum.x += row[a] * row[a];
  sum.p = row[R::p] * row[R::p];
  sum.von_mises = 1.5 * contracted<Dim>(row + R::s);
  return sum;
}

}  // namespace

void IndicatorRecord::take(const Reading& now, double time) {
  last = now.share();
  greatest_whole = std::max(greatest_whole, now.whole);
  if (!(now.part > greatest_part)) return;  // nor what is no number
  greatest_part = now.part;
  at = time;
}

IndicatorGauge::IndicatorGauge(const Scene& scene, const Snapshot& start)
    : part_(alternating_part(start, scene.spacing)), spacing_(scene.spacing) {
  for (const Material& each : scene.materials)
    least_stress_ = std::max(least_stress_, least_strain * each.youngs_modulus);
}

Readings IndicatorGauge::operator()(const Snapshot& now) {
  return now.dim == 3 ? read<3>(now) : read<2>(now);
}

template <int Dim>
Readings IndicatorGauge::read(const Snapshot& now) {
  fill<Dim>(table_, now);
  Squares alternating, whole;
  for (int i = 0; i < part_.rows(); ++i) {
    const double* own = table_.data() + std::ptrdiff_t{part_.j[part_.begin[i]]} * Row<Dim>::width;
    const Squares part = squares<Dim>(filtered<Dim>(part_, i, table_.data()).data());
    const Squares all = squares<Dim>(own);
    alternating.x += std::min(part.x, spacing_ * spacing_);
    alternating.p += part.p;
    alternating.von_mises += part.von_mises;
    whole.p += all.p;
    whole.von_mises += all.von_mises;
  }
  const auto rms = [count = std::max(1, part_.rows())](double sum) { return std::sqrt(sum / count); };
  const auto stress = [&](double sum) { return std::max(rms(sum), least_stress_); };
  return {Reading{rms(alternating.x), spacing_}, Reading{rms(alternating.p), stress(whole.p)},
          Reading{rms(alternating.von_mises), stress(whole.von_mises)}};
}

}  // namespace taut
