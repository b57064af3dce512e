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

/// What a reference says over time, of each probe of a measure: a table or an exact solution, or neither.
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

/// What a measure is made from.
struct MeasureSource {
  const Measure* measure = nullptr;
  std::vector<Curve> curve;                          // of each probe, none of them empty
  std::optional<Curve> free;                         // of the probe `free`
  ReferenceCurves reference;                         // none where there is no reference
  std::optional<double> reference_value;             // the same
  const SampleLine* line = nullptr;                  // of a measure of a line
  const std::vector<LineSample>* samples = nullptr;  // of the line
  const Snapshot* now = nullptr;                     // the present state, if it is known
  double until = 0;                                  // s
  bool turns = true;                                 // an extreme at the end is not the last word
};

/// The number of a measure, or why there is none.
struct Measured {
  std::optional<double> value;
  std::string why;

  Measured(double number) : value(number) {}
  explicit Measured(std::string reason) : why(std::move(reason)) {}
};

/// Written like a value.
template <class... Args>
Measured none(fmt::format_string<Args...> why, Args&&... args) {
  return Measured(fmt::format(why, std::forward<Args>(args)...));
}
inline Measured too_short(double wanted, double reached) {
  return none("the run ends at {:g} s, before {:g} s", reached, wanted);
}

/// Why a measure that needs one has no value.
inline constexpr const char* no_reference = "there is no reference to compare with";

/// A kind of measure. A new one is a function and a row in measure_kinds.cpp.
struct MeasureKind {
  using Value = Measured (*)(const MeasureSource&);
  using Reference = std::optional<double> (*)(const MeasureSource&);

  std::string_view name, help;
  /// Of a scene file, beside `name`, `of` and `unit`, first what it is made from. `probes` stands for one
  /// probe for each axis.
  std::vector<std::string_view> keys;
  bool number = false, table = false, solution = false;  // what a reference has for it
  Value value;
  Reference reference;  // what it is compared with; asked where a reference is there
};

/// Every kind, in the order in which they are listed.
std::span<const MeasureKind> measure_kinds();
/// nullptr if there is none of that name.
const MeasureKind* find_measure_kind(std::string_view name);

/// A difference from a reference, which there must be for a value: the reference of the measure itself is 0.
constexpr bool is_difference(std::string_view kind) {
  return kind == "rmse" || kind == "path_error" || kind.starts_with("line_") || kind.starts_with("field_");
}

}  // namespace taut
