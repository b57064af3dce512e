#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "engine/core/isa.hpp"

namespace taut::inline TAUT_ISA {

/// Rows of constants, one behind the other, of which two that are equal to the last bit are one: particles
/// inside a lattice all have the same.
template <class T>
class SharedRows {
 public:
  /// Where it begins.
  int add(const std::vector<T>& row) {
    const std::string bytes(reinterpret_cast<const char*>(row.data()), row.size() * sizeof(T));
    const auto [known, is_new] = begin_.try_emplace(bytes, static_cast<int>(all_.size()));
    if (is_new) all_.insert(all_.end(), row.begin(), row.end());
    return known->second;
  }
  const T& operator[](int k) const { return all_[k]; }
  /// Nothing will be added any more.
  void close() { begin_ = {}, all_.shrink_to_fit(); }

 private:
  std::vector<T> all_;
  std::unordered_map<std::string, int> begin_;  // of bytes
};

}  // namespace taut::inline TAUT_ISA
