#pragma once

#include <vector>

#include "engine/core/pack.hpp"

namespace taut::inline TAUT_ISA {

/// N numbers of each particle, column by column: four particles that are stored one behind the other have four
/// numbers one behind the other in each.
template <int N>
class Columns {
 public:
  /// All zero.
  void resize(int size) {
    size_ = (size + lanes - 1) / lanes * lanes;
    all_.assign(static_cast<std::size_t>(N) * size_, 0.0);
  }
  /// In whole packs.
  int size() const { return size_; }

  double* operator[](int k) { return all_.data() + static_cast<std::ptrdiff_t>(k) * size_; }
  const double* operator[](int k) const { return all_.data() + static_cast<std::ptrdiff_t>(k) * size_; }

 private:
  int size_ = 0;
  std::vector<double> all_;
};

}  // namespace taut::inline TAUT_ISA
