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

struct MeasureSource {
  const Measure* measure = nullptr;
  std::vector<Curve> curve;  // [probe]
  std::optional<Curve> free;
  ReferenceCurves reference;  // may be empty
  std::optional<double> reference_value;
  const SampleLine* line = nullptr;  // may be null
  const std::vector<LineSample>* samples = nullptr;
  const Snapshot* now = nullptr;  // may be null
  double until = 0;               // s
  bool end_extreme_may_grow = true;
};

struct Measured {
  std::optional<double> value;
  std::string why;

  Measured(double number) : value(number) {}
  explicit Measured(std::string reason) : why(std::move(reason)) {}
};

template <class... Args>
Measured none(fmt::format_string<Args...> why, Args&&... args) {
  return Measured(fmt::format(why, std::forward<Args>(args)...));
}
inline Measured too_short(double wanted, double reached) {
  return none("the run ends at {:g} s, before {:g} s", reached, wanted);
}

inline constexpr const char* no_reference = "there is no reference to compare with";

struct MeasureKind {
  using Value = Measured (*)(const MeasureSource&);
  using Reference = std::optional<double> (*)(const MeasureSource&);

  std::string_view name, help;
  /// Keys beside `name`, `of` and `unit`. `probes`: one per axis.
  std::vector<std::string_view> keys;
  /// Possible references; `number` includes a solution.
  bool number = false, table = false, solution = false;
  Value value;
  Reference reference;
};

std::span<const MeasureKind> measure_kinds();
/// Returns nullptr if unknown.
const MeasureKind* find_measure_kind(std::string_view name);

/// Kinds with reference 0.
constexpr bool is_difference(std::string_view kind) {
  return kind == "rmse" || kind == "path_error" || kind.starts_with("line_") || kind.starts_with("field_");
}

}  // namespace taut
