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

/// What all cursors of one file share.
struct TomlSource {
  std::string file;
  int dim = 3;                 // of the scene: in 2D no place has a z
  std::set<std::string> used;  // names that some expression has asked for
};

/// Typed access to one table of a scene file. It knows the keys that the table may have; to ask for another
/// one is an error of the reader. It remembers which were asked for, so that `finish` finds the ones that
/// nobody reads, and writes defaults into the table, so that the table ends up complete. Every error of the
/// file is a SceneError with the place of the value.
class TomlCursor {
 public:
  /// `path` is the dotted path ("body.left") and `what` the table's name in messages ("body 'left'").
  TomlCursor(TomlValue& table, std::string path, std::string what, std::span<const KeyInfo> keys, Names names,
             TomlSource& source);

  TomlValue& table() { return table_; }
  const std::string& path() const { return path_; }
  const std::string& what() const { return what_; }
  Names& names() { return names_; }
  TomlSource& source() { return source_; }

  /// More keys that the table may have: those of its kind.
  void also_takes(std::span<const KeyInfo> keys);
  void also_takes(const KeyInfo& key) { also_takes({&key, 1}); }

  /// nullptr if it is missing; from now on the key is known.
  TomlValue* find(std::string_view key);
  TomlValue& need(std::string_view key);

  std::string text(std::string_view key);
  std::string text(std::string_view key, std::string_view otherwise);
  /// A text of one line and at most 200 letters, for what people read in pictures and tables.
  std::string line(std::string_view key);
  std::string line(std::string_view key, std::string_view otherwise);
  /// A text that is one of `allowed`.
  std::string choice(std::string_view key, const std::vector<std::string>& allowed);
  double number(std::string_view key);
  double number(std::string_view key, double otherwise);
  double positive(std::string_view key);
  int whole(std::string_view key, int otherwise, int low, int high);
  /// true or false; false if it is missing, without writing that.
  bool flag(std::string_view key);
  /// One number per component; an array of `size` numbers.
  std::vector<double> numbers(std::string_view key, std::size_t size);
  Point point(std::string_view key, int dim);

  /// A number or the value of an expression; `what` names it in messages.
  double value_of(const TomlValue& value, std::string_view key);
  /// A function of the position, which throws SceneError where its value is not finite; empty for 0.
  Expression function_of(const TomlValue& value, std::string_view key);
  /// The same, of the time t in s.
  std::function<double(double)> function_of_time(const TomlValue& value, std::string_view key);
  /// The same, of the position and the time.
  Solution solution(const TomlValue& value, std::string_view key);
  /// A function of values of those of these names that are names of variables too, and of the time t.
  std::function<double(const std::vector<double>&, double)> function_of_probes(
      const TomlValue& value, std::string_view key, const std::vector<std::string>& probes);
  std::string text_of(const TomlValue& value, std::string_view key);

  /// A cursor on the table `value` with such keys, with the same names.
  TomlCursor enter(TomlValue& value, std::string_view key, std::string what, std::span<const KeyInfo> keys);
  /// The table `key`, written with its defaults if it is missing.
  TomlCursor section(std::string_view key, std::string what, std::span<const KeyInfo> keys);
  /// The tables of [[key]], none if it is missing.
  std::span<TomlValue> list(std::string_view key);

  [[noreturn]] void fail(FilePlace place, std::string_view key, const std::string& message) const;
  [[noreturn]] void fail(const TomlValue& value, std::string_view key, const std::string& message) const;
  /// The error for a name that is not among `known`.
  [[noreturn]] void fail_unknown(const TomlValue& value, std::string_view key, std::string_view kind,
                                 std::string_view given, const std::vector<std::string>& known) const;
  /// The names of an expression are in use.
  void note_names(const std::string& text);
  /// Throws for the first key that the table may not have.
  void refuse_unknown_keys() const;
  /// The same, and for the first one that nobody has asked for.
  void finish() const;

 private:
  [[noreturn]] void fail_expression(const TomlValue& value, std::string_view key,
                                    const ExpressionError& error) const;
  /// `compile`(text, names) as a function whose value is checked to be finite; `show` says where.
  template <class... Arguments, class Compile, class Show>
  std::function<double(Arguments...)> function(const TomlValue& value, std::string_view key,
                                               const Compile& compile, const Show& show);
  void refuse_third_axis(const TomlValue& value, std::string_view key) const;
  std::string full_path(std::string_view key) const;
  bool may_have(std::string_view key) const;

  TomlValue& table_;
  std::string path_, what_;
  Names names_;
  TomlSource& source_;
  std::vector<std::string> keys_;
};

/// Letters, digits and '_', not starting with a digit: what an expression can name.
bool is_identifier(std::string_view name);

}  // namespace taut::cli
