#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/diagnostics/curve.hpp"
#include "engine/diagnostics/lines.hpp"
#include "engine/scene/scene.hpp"
#include "engine/snapshot.hpp"

namespace taut {

/// Reference over time for each probe of a measure: a table, an exact solution, or neither.
struct ReferenceCurves {
  std::vector<Curve> table;
  const std::vector<Solution>* exact = nullptr;

  bool empty() const { return table.empty() && exact == nullptr; }
  double begin() const { return exact ? 0 : table.front().t.front(); }
  double end() const { return exact ? std::numeric_limits<double>::infinity() : table.front().t.back(); }
  double at(std::size_t probe, double t) const {
    return exact ? (*exact)[probe]({}, t) : value_at(table[probe], t);
  }
};

/// Data for one measure.
struct MeasureSource {
  const Measure* measure = nullptr;
  std::vector<Curve> curve;   // [probe], not empty
  std::optional<Curve> free;  // series of the probe `free`
  ReferenceCurves reference;  // may be empty
  std::optional<double> reference_value;
  const SampleLine* line = nullptr;  // for a measure of a line
  const std::vector<LineSample>* samples = nullptr;
  const Snapshot* now = nullptr;  // current state, if known
  double until = 0;               // s
  bool turns = true;              // an extreme at the end may still grow
};

/// Value of a measure, or the reason why there is none.
struct Measured {
  std::optional<double> value;
  std::string why;

  Measured(double number) : value(number) {}
  explicit Measured(std::string reason) : why(std::move(reason)) {}
};

/// Returns a reason, formatted with fmt.
template <class... Args>
Measured none(fmt::format_string<Args...> why, Args&&... args) {
  return Measured(fmt::format(why, std::forward<Args>(args)...));
}
inline Measured too_short(double wanted, double reached) {
  return none("the run ends at {:g} s, before {:g} s", reached, wanted);
}

inline constexpr const char* no_reference = "there is no reference to compare with";

/// A kind of measure. A new one is a function and a row in measure_kinds.cpp.
struct MeasureKind {
  using Value = Measured (*)(const MeasureSource&);
  using Reference = std::optional<double> (*)(const MeasureSource&);

  std::string_view name, help;
  /// Keys in a scene file beside `name`, `of` and `unit`, the source first. `probes`: one probe per axis.
  std::vector<std::string_view> keys;
  bool number = false, table = false, solution = false;  // possible kinds of reference
  Value value;
  Reference reference;  // called only if the scene has a reference
};

/// All kinds in listing order.
std::span<const MeasureKind> measure_kinds();
/// nullptr if the name is unknown.
const MeasureKind* find_measure_kind(std::string_view name);

/// The kind's value is a difference from a reference, whose own value is therefore 0.
constexpr bool is_difference(std::string_view kind) {
  return kind == "rmse" || kind == "path_error" || kind.starts_with("line_") || kind.starts_with("field_");
}

}  // namespace taut
