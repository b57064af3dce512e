#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/tensor.hpp"

namespace taut::inline TAUT_ISA {

/// Geometry of four pairs.
template <int Dim>
struct PairGeometry {
  Vec<Pack, Dim> gradient;  // ∇_i W = ∂W/∂r e_ij, 1/m^(Dim+1)
  Pack inverse_slope;       // 1/(∂W/∂r)
  Pack inverse_distance;    // (1/r)/(∂W/∂r); 0 for pairs of two bodies: no shear between them
};

/// The geometry of all pairs, pack by pack, held till the next rebuild; 0 in the filling. Gradients are opposite in
/// (i, j) and (j, i) to the last bit. In 3D, where pairs are many, it is kept in single precision, in the units of
/// the kernel, so that numbers have room whatever a metre is to the spacing; sums over pairs are in double.
template <int Dim>
class HeldPairs {
 public:
  static constexpr bool halved = Dim == 3;
  /// Of −r ∂W/∂r in those units, below which a pair at the edge of the kernel, or in one place, has no geometry:
  /// the inverses would be too great.
  static constexpr double least = halved ? 1e-30 : 0;

  /// For so many packs, of a kernel of this steepness, 1/m^(Dim+1), and length, m.
  void make_room(std::size_t packs, bool with_closeness, double steepness, double length) {
    gradients_.resize(packs), inverse_slopes_.resize(packs), inverse_distances_.resize(packs);
    if (with_closeness) closeness_.resize(packs);
    if constexpr (halved) steepness_ = steepness, length_ = length;
  }

  void set(int b, const PairGeometry<Dim>& pairs) {
    for (int k = 0; k < Dim; ++k) pack_into(gradients_[b][k], pairs.gradient[k] * (1 / steepness_));
    pack_into(inverse_slopes_[b], pairs.inverse_slope * steepness_);
    pack_into(inverse_distances_[b], pairs.inverse_distance * (steepness_ * length_));
  }
  /// (W/W(dp))ⁿ
  void set_closeness(int b, const Pack& closeness) { pack_into(closeness_[b], closeness); }
  Pack closeness(int b) const { return unpacked(closeness_[b]); }
  PairGeometry<Dim> operator[](int b) const { return {gradient(b), inverse_slope(b), inverse_distance(b)}; }
  Vec<Pack, Dim> gradient(int b) const {
    Vec<Pack, Dim> g;
    for (int k = 0; k < Dim; ++k) g[k] = scaled(unpacked(gradients_[b][k]), steepness_);
    return g;
  }
  Pack inverse_slope(int b) const { return scaled(unpacked(inverse_slopes_[b]), 1 / steepness_); }
  Pack inverse_distance(int b) const {
    return scaled(unpacked(inverse_distances_[b]), 1 / (steepness_ * length_));
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(gradients_, inverse_slopes_, inverse_distances_, closeness_, steepness_, length_);
  }
  bool are_of(int packs, bool with_closeness) const {
    const auto of_all = [&](const auto& list) { return std::cmp_equal(list.size(), packs); };
    return of_all(gradients_) && of_all(inverse_slopes_) && of_all(inverse_distances_) &&
           (with_closeness ? of_all(closeness_) : closeness_.empty()) && steepness_ > 0 && length_ > 0;
  }

 private:
  using Kept = std::conditional_t<halved, HalfPack, StoredPack>;
  static Pack scaled(const Pack& a, double unit) {
    if constexpr (halved) return unit * a;
    return a;
  }

  std::vector<std::array<Kept, Dim>> gradients_;
  std::vector<Kept> inverse_slopes_, inverse_distances_;
  std::vector<Kept> closeness_;  // where the method has artificial stress
  double steepness_ = 1, length_ = 1;
};

}  // namespace taut::inline TAUT_ISA
