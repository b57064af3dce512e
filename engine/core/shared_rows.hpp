#pragma once

#include <functional>
#include <string_view>
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
    const std::string_view bytes(reinterpret_cast<const char*>(row.data()), row.size() * sizeof(T));
    const std::size_t hash = std::hash<std::string_view>()(bytes);
    const auto [from, to] = begin_.equal_range(hash);
    for (auto known = from; known != to; ++known) {
      const T* other = all_.data() + known->second;
      if (row.size() <= all_.size() - static_cast<std::size_t>(known->second) &&
          std::string_view(reinterpret_cast<const char*>(other), bytes.size()) == bytes)
        return known->second;
    }
    const int begin = static_cast<int>(all_.size());
    begin_.emplace(hash, begin);
    all_.insert(all_.end(), row.begin(), row.end());
    return begin;
  }
  const T& operator[](int k) const { return all_[k]; }
  /// Nothing will be added any more.
  void close() { begin_ = {}, all_.shrink_to_fit(); }

 private:
  std::vector<T> all_;
  std::unordered_multimap<std::size_t, int> begin_;  // by the hash of their bytes
};

}  // namespace taut::inline TAUT_ISA
