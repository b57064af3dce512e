#pragma once

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

/// What a Saver and a Loader have in common: `archive(a, b, …)` goes through values in a fixed order, so that
/// one list of members serves both directions. A class lists its own in `serialize(Archive&)`; what is copied
/// byte by byte needs none. Only for one machine and one build: sizes and byte order are those of memory.
template <class Side>
class Archive {
 public:
  template <class... T>
  void operator()(T&... values) {
    (one(values), ...);
  }

 private:
  Side& side() { return static_cast<Side&>(*this); }

  template <class T>
  static constexpr bool lists_members = requires(T& value, Side& side) {
    value.serialize(side);
  };

  template <class T>
  void one(T& value) {
    if constexpr (lists_members<T>) {
      value.serialize(side());
    } else {
      static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>, "give it a `serialize`");
      side().bytes(&value, sizeof(T));
    }
  }
  template <class T>
  void one(std::vector<T>& values) {
    values.resize(side().length(values.size()));
    if constexpr (std::is_same_v<T, bool>) {
      for (std::size_t k = 0; k < values.size(); ++k) {
        bool value = values[k];
        one(value);
        values[k] = value;
      }
    } else if constexpr (std::is_trivially_copyable_v<T> && !lists_members<T>) {
      side().bytes(values.data(), values.size() * sizeof(T));
    } else {
      for (T& value : values) one(value);
    }
  }
  void one(std::string& text) {
    text.resize(side().length(text.size()));
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

/// Writes values to a string of bytes.
class Saver : public Archive<Saver> {
 public:
  /// `value` must be the same where it is loaded.
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
  std::size_t length(std::uint64_t n) {
    bytes(&n, sizeof n);
    return n;
  }

  std::string bytes_;
};

/// Reads them back. Throws UsageError when they are not what a Saver wrote for the same list of values.
class Loader : public Archive<Loader> {
 public:
  explicit Loader(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  void match(const T& value) {
    T found{};
    (*this)(found);
    if (!(found == value)) fail();
  }
  /// To be called last: nothing may be left over.
  void finish() const {
    if (!rest_.empty()) fail();
  }

 private:
  friend Archive<Loader>;
  void bytes(void* to, std::size_t size) {
    if (size > rest_.size()) fail();
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  std::size_t length(std::size_t) {
    std::uint64_t n = 0;
    bytes(&n, sizeof n);
    if (n > rest_.size()) fail();  // every element takes at least a byte
    return n;
  }
  [[noreturn]] static void fail() {
    throw UsageError("the saved state is damaged, or of another scene, method or version");
  }

  std::string_view rest_;
};

}  // namespace taut
