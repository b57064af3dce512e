#pragma once

#include <algorithm>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/growth.hpp"

namespace taut {

/// Stores bit-identical rows once.
template <class T>
class SharedRows {
 public:
  SharedRows() = default;
  explicit SharedRows(int rows) : rows_(static_cast<std::size_t>(rows)) {}

  /// Thread-safe.
  static std::size_t hash_of(const std::vector<T>& row) {
    return std::hash<std::string_view>()(bytes_of(row));
  }
  int add(const std::vector<T>& row) { return add(row, hash_of(row)); }
  int add(const std::vector<T>& row, std::size_t hash) {
    const std::string_view bytes = bytes_of(row);
    ++added_;
    if (2 * known_ >= table_.size()) grow();
    std::size_t at = first_of(hash);
    for (; table_[at].begin >= 0; at = next(at))
      if (table_[at].hash == hash && equals_at(bytes, row.size(), table_[at].begin)) return table_[at].begin;
    const int begin = static_cast<int>(all_.size());
    table_[at] = {hash, begin};
    ++known_;
    make_room(all_, row.size(), added_ - 1, rows_);
    all_.insert(all_.end(), row.begin(), row.end());
    return begin;
  }
  const T& operator[](int k) const { return all_[k]; }
  /// An empty row may begin at the end of all rows.
  const T* from(int k) const { return all_.data() + k; }
  /// Frees the search table; no `add` may follow.
  void close() { table_ = std::vector<Known>(); }  // {} would keep the capacity

 private:
  struct Known {
    std::size_t hash = 0;
    int begin = -1;
  };

  static std::string_view bytes_of(const std::vector<T>& row) {
    return {reinterpret_cast<const char*>(row.data()), row.size() * sizeof(T)};
  }
  bool equals_at(std::string_view bytes, std::size_t size, int begin) const {
    const char* const there = reinterpret_cast<const char*>(all_.data() + begin);
    return size <= all_.size() - static_cast<std::size_t>(begin) &&
           std::string_view(there, bytes.size()) == bytes;
  }
  std::size_t first_of(std::size_t hash) const { return hash & (table_.size() - 1); }
  std::size_t next(std::size_t at) const { return first_of(at + 1); }
  void grow() {
    std::vector<Known> before(std::max<std::size_t>(64, 2 * table_.size()));
    std::swap(before, table_);
    for (const Known& one : before) {
      if (one.begin < 0) continue;
      std::size_t at = first_of(one.hash);
      while (table_[at].begin >= 0) at = next(at);
      table_[at] = one;
    }
  }

  std::vector<T> all_;
  std::vector<Known> table_;
  std::size_t known_ = 0, added_ = 0, rows_ = 0;
};

}  // namespace taut
