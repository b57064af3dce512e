#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/error.hpp"

namespace taut {

template <class T>
concept Count = std::integral<T> && !std::same_as<T, bool>;

/// Whether 0 ≤ value < bound.
template <Count T, Count Bound>
bool is_below(T value, Bound bound) {
  return std::cmp_greater_equal(value, 0) && std::cmp_less(value, bound);
}
template <Count T, Count Bound>
bool is_below(const std::pair<T, T>& pair, const std::pair<Bound, Bound>& bound) {
  return is_below(pair.first, bound.first) && is_below(pair.second, bound.second);
}

/// Whether `begin` contains `rows` ascending offsets from 0, then the number `entries`.
template <Count T>
bool are_rows(const std::vector<T>& begin, std::size_t rows, std::size_t entries) {
  return begin.size() == rows + 1 && begin.front() == 0 && std::cmp_equal(begin.back(), entries) &&
         std::is_sorted(begin.begin(), begin.end());
}

/// A class lists its members in `serialize(Archive&)`; a struct without it is copied bytewise and must contain only
/// numbers. A state is valid for one machine and build only. Loaded data is untrusted: values that address memory must
/// be listed with `fixed`, `indices`, `rows` or `check`.
template <class Side>
class Archive {
 public:
  template <class... T>
  void operator()(T&... values) {
    (one(values), ...);
  }

  /// Lists whose length must not change.
  template <class... T>
  void fixed(std::vector<T>&... lists) {
    (one_fixed(lists), ...);
  }
  template <class T, class Bound>
  void indices(std::vector<T>& list, const Bound& bound) {
    one(list);
    check("an index", [&] { return are_below(list, bound); });
  }
  /// Row i is list[width · begin[i]] … list[width · begin[i + 1] − 1].
  template <class T, class Bound>
  void rows(std::vector<int>& begin, std::size_t count, std::vector<T>& list, const Bound& bound,
            std::size_t width = 1) {
    one(begin);
    indices(list, bound);
    check("a list of lists",
          [&] { return list.size() % width == 0 && are_rows(begin, count, list.size() / width); });
  }
  /// When loading, throws UsageError about `what` unless `is_right()`.
  template <class Test>
  void check(const char* what, const Test& is_right) {
    if constexpr (Side::loads)
      if (!is_right()) Side::fail(what);
  }

 private:
  Side& side() { return static_cast<Side&>(*this); }

  template <class T>
  static constexpr bool lists_members = requires(T& value, Side& side) {
    value.serialize(side);
  };
  template <class T>
  static constexpr bool is_copied =
      std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool> && !lists_members<T>;

  template <class T, class Bound>
  static bool are_below(const std::vector<T>& list, const Bound& bound) {
    return std::all_of(list.begin(), list.end(), [&](const T& value) { return is_below(value, bound); });
  }

  template <class T>
  void one(T& value) {
    if constexpr (lists_members<T>) {
      value.serialize(side());
    } else {
      static_assert(is_copied<T> && !std::is_pointer_v<T>, "give it a `serialize`");
      side().bytes(&value, sizeof(T));
    }
  }
  void one(bool& value) {
    unsigned char byte = value;
    side().bytes(&byte, 1);
    check("a truth value", [&] { return byte <= 1; });
    value = byte == 1;
  }
  template <class T>
  void one(std::vector<T>& values) {
    const std::size_t size = side().length(values.size(), is_copied<T> ? sizeof(T) : 1);
    if (is_copied<T> || values.size() > size) values.resize(size);
    elements(values, size);
  }
  /// Not inlined, so that the portable build has its own copy: the linker could otherwise call one of an AVX build.
  template <class T>
  [[gnu::noinline]] void one_fixed(std::vector<T>& values) {
    const std::size_t size = side().length(values.size(), 1);
    check("the length of a list", [&] { return size == values.size(); });
    elements(values, size);
  }
  template <class T>
  void elements(std::vector<T>& values, std::size_t size) {
    if constexpr (is_copied<T>) {
      side().bytes(values.data(), size * sizeof(T));
    } else {
      for (std::size_t k = 0; k < size; ++k) {
        if (k == values.size()) values.emplace_back();
        if constexpr (std::is_same_v<T, bool>) {
          bool value = values[k];
          one(value);
          values[k] = value;
        } else {
          one(values[k]);
        }
      }
    }
  }
  void one(std::string& text) {
    text.resize(side().length(text.size(), 1));
    side().bytes(text.data(), text.size());
  }
  template <class A, class B>
  void one(std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <class T>
  void one(std::optional<T>& value) {
    bool there = value.has_value();
    one(there);
    if (there && !value) value.emplace();
    if (!there) value.reset();
    if (there) one(*value);
  }
  template <class Key, class T>
  void one(std::map<Key, T>& map) {
    std::vector<std::pair<Key, T>> entries(map.begin(), map.end());
    one(entries);
    map = {entries.begin(), entries.end()};
  }
};

class Saver : public Archive<Saver> {
 public:
  static constexpr bool loads = false;

  /// Saves a value that must be equal when loaded.
  template <class T>
  void match(const T& value) {
    T copy = value;
    (*this)(copy);
  }
  std::string take() { return std::move(bytes_); }

 private:
  friend Archive<Saver>;
  void bytes(const void* from, std::size_t size) {
    if (size > 0) bytes_.append(static_cast<const char*>(from), size);
  }
  std::size_t length(std::uint64_t n, std::size_t) {
    bytes(&n, sizeof n);
    return n;
  }

  std::string bytes_;
};

/// Throws UsageError for invalid bytes.
class Loader : public Archive<Loader> {
 public:
  static constexpr bool loads = true;

  explicit Loader(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  void match(const T& value) {
    T found{};
    (*this)(found);
    if (!(found == value)) fail("the number of particles or probes");
  }
  /// Call last: throws UsageError if bytes remain.
  void finish() const {
    if (!rest_.empty()) fail("its length");
  }

 private:
  friend Archive<Loader>;
  void bytes(void* to, std::size_t size) {
    if (size > rest_.size()) fail("its length");
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  std::size_t length(std::size_t, std::size_t least) {
    std::uint64_t n = 0;
    bytes(&n, sizeof n);
    if (n > rest_.size() / least) fail("the length of a list");
    return n;
  }
  [[noreturn]] static void fail(const char* what) {
    throw UsageError(std::string("the saved state is damaged, or from another scene, method or version: ") +
                     what + " is invalid");
  }

  std::string_view rest_;
};

}  // namespace taut
