#pragma once

#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/scene/expression.hpp"
#include "cli/scene/key_info.hpp"
#include "cli/scene/toml_tree.hpp"

namespace taut::cli {

struct TomlSource {
  std::string file;
  int dim = 3;                 // expressions of 2D scenes have no z
  std::set<std::string> used;  // names in expressions
};

/// Adds defaults to the table. Throws SceneError for a wrong or missing value, std::logic_error if a reader requests a
/// key outside `keys`.
class TomlCursor {
 public:
  /// `path` is dotted; `what` is for messages.
  TomlCursor(TomlValue& table, std::string path, std::string what, std::span<const KeyInfo> keys, Names names,
             TomlSource& source);

  TomlValue& table() { return table_; }
  const std::string& path() const { return path_; }
  const std::string& what() const { return what_; }
  Names& names() { return names_; }
  TomlSource& source() { return source_; }

  void also_takes(std::span<const KeyInfo> keys);
  void also_takes(const KeyInfo& key) { also_takes({&key, 1}); }

  /// Marks the key as read; returns nullptr if missing.
  TomlValue* find(std::string_view key);
  TomlValue& need(std::string_view key);

  std::string text(std::string_view key);
  std::string text(std::string_view key, std::string_view otherwise);
  /// One UTF-8 line of at most 200 bytes.
  std::string line(std::string_view key);
  std::string line(std::string_view key, std::string_view otherwise);
  std::string choice(std::string_view key);
  std::string choice(std::string_view key, const std::vector<std::string>& allowed);
  double number(std::string_view key);
  double number(std::string_view key, double otherwise);
  int whole(std::string_view key);
  /// A missing key is false, and not added.
  bool flag(std::string_view key);
  std::vector<double> numbers(std::string_view key, std::size_t size);
  Point point(std::string_view key, int dim);

  /// Finite value, also of an expression.
  double value_of(const TomlValue& value, std::string_view key);
  /// Function of position; empty for the constant 0. Calls throw SceneError for non-finite values.
  Expression function_of(const TomlValue& value, std::string_view key);
  /// Function of time, s.
  std::function<double(double)> function_of_time(const TomlValue& value, std::string_view key);
  /// Never empty.
  Solution solution(const TomlValue& value, std::string_view key);
  Solution solution_of_time(const TomlValue& value, std::string_view key);
  /// Function of probes and time, s.
  std::function<double(const std::vector<double>&, double)> function_of_probes(
      const TomlValue& value, std::string_view key, const std::vector<std::string>& probes);
  std::string text_of(const TomlValue& value, std::string_view key);

  TomlCursor enter(TomlValue& value, std::string_view key, std::string what, std::span<const KeyInfo> keys);
  /// Adds a missing table.
  TomlCursor section(std::string_view key, std::string what, std::span<const KeyInfo> keys);
  /// Empty if missing.
  std::span<TomlValue> list(std::string_view key);

  [[noreturn]] void fail(FilePlace place, std::string_view key, const std::string& message) const;
  [[noreturn]] void fail(const TomlValue& value, std::string_view key, const std::string& message) const;
  [[noreturn]] void fail_unknown(const TomlValue& value, std::string_view key, std::string_view kind,
                                 std::string_view given, const std::vector<std::string>& known) const;
  void mark_names_used(const std::string& text);
  void refuse_unknown_keys() const;
  /// Throws for unknown and unread keys.
  void finish() const;

 private:
  [[noreturn]] void fail_expression(const TomlValue& value, std::string_view key,
                                    const ExpressionError& error) const;
  template <class... Arguments, class Compile, class Show>
  std::function<double(Arguments...)> function(const TomlValue& value, std::string_view key,
                                               const Compile& compile, const Show& show);
  void refuse_third_axis(const TomlValue& value, std::string_view key) const;
  std::string full_path(std::string_view key) const;
  /// nullptr if the key is not allowed.
  const KeyInfo* row(std::string_view key) const;
  void check_bounds(const TomlValue& value, std::string_view key, std::string_view shown,
                    double number) const;

  TomlValue& table_;
  std::string path_, what_;
  Names names_;
  TomlSource& source_;
  std::vector<KeyInfo> rows_;
};

/// Letters, digits and '_', no digit first.
bool is_identifier(std::string_view name);

}  // namespace taut::cli
