#include "cli/formats/particle_arrays.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace taut::cli {
namespace {

using Names = std::array<std::string_view, 6>;
using Type = ParticleArray::Type;

constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
constexpr Names tensor{"xx", "yy", "zz", "xy", "yz", "xz"};
constexpr Names strains{"strain_xx", "strain_yy", "strain_zz", "strain_xy", "strain_yz", "strain_xz"};

bool any_begins_with(std::span<const Field* const> fields, std::string_view beginning) {
  return std::ranges::any_of(fields, [&](const Field* field) { return field->key.starts_with(beginning); });
}

std::vector<double> with_three_components(const std::vector<double>& vectors, int dim) {
  const auto d = static_cast<std::size_t>(dim);
  std::vector<double> three(3 * (vectors.size() / d));
  for (std::size_t i = 0; i < vectors.size(); ++i) three[3 * (i / d) + i % d] = vectors[i];
  return three;
}

template <class Number>
ParticleArray numbers(std::string_view name, const std::vector<Number>& values, Type type) {
  return {name, "", {values.begin(), values.end()}, type};
}

ParticleArray vectors(std::string_view name, std::string_view unit, const std::vector<double>& values,
                      int dim) {
  return {name, unit, with_three_components(values, dim), Type::real, axes};
}

ParticleArray ids(std::size_t count) {
  std::vector<double> number(count);
  std::iota(number.begin(), number.end(), 0.0);
  return {"id", "", std::move(number), Type::whole};
}

ParticleArray volumes(const Snapshot& now) {
  std::vector<double> volume(now.size());
  for (std::size_t i = 0; i < volume.size(); ++i) volume[i] = now.m[i] / now.rho[i];
  return {"volume", now.dim == 3 ? "m³" : "m²", std::move(volume)};
}

ParticleArray displacements(const Snapshot& now) {
  std::vector<double> moved(now.x.size());
  for (std::size_t k = 0; k < moved.size(); ++k) moved[k] = now.x[k] - now.x0[k];
  return vectors("displacement_vector", "m", moved, now.dim);
}

ParticleArray stresses(const Snapshot& now) {
  std::vector<double> stress;
  stress.reserve(tensor.size() * now.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    const StressTensor t = now.stress(i);
    stress.insert(stress.end(), {t.xx, t.yy, t.zz, t.xy, t.yz, t.xz});
  }
  return {"stress", "Pa", std::move(stress), Type::real, tensor};
}

/// In 2D, components without field are 0 (plane strain).
ParticleArray strain_tensors(const Snapshot& now, std::span<const Field* const> fields,
                             const std::vector<std::vector<double>>& values) {
  std::vector<double> strain(tensor.size() * now.size());
  for (std::size_t c = 0; c < strains.size(); ++c) {
    const auto field = std::ranges::find(fields, strains[c], &Field::key);
    if (field == fields.end()) continue;
    const std::vector<double>& component = values[static_cast<std::size_t>(field - fields.begin())];
    for (std::size_t i = 0; i < now.size(); ++i) strain[tensor.size() * i + c] = component[i];
  }
  return {"strain", "", std::move(strain), Type::real, tensor};
}

}  // namespace

std::span<const std::string_view> tensor_components() { return tensor; }

ParticleArray position_array(const Snapshot& now) { return vectors("Points", "m", now.x, now.dim); }

std::vector<ParticleArray> particle_arrays(const Snapshot& now, std::span<const Field* const> fields) {
  std::vector<const Field*> measured(fields.begin(), fields.end());
  std::erase_if(measured, [](const Field* field) { return field->counts != Counted::nothing; });
  const std::size_t requested = measured.size();
  const bool with_strain = any_begins_with(fields, "strain_");
  for (const std::string_view key : strains)
    if (const Field* field = find_field(key, now.dim);
        with_strain && field && std::ranges::count(measured, field) == 0)
      measured.push_back(field);
  std::vector<std::vector<double>> values = evaluate(measured, now);

  std::vector<ParticleArray> last;
  if (any_begins_with(fields, "stress_")) last.push_back(stresses(now));
  if (with_strain) last.push_back(strain_tensors(now, measured, values));
  std::vector<ParticleArray> all;
  for (std::size_t k = 0; k < requested; ++k)
    all.push_back({measured[k]->key, measured[k]->unit, std::move(values[k])});
  all.push_back({"diameter", "m", now.diameter});
  all.push_back(vectors("velocity", "m/s", now.v, now.dim));
  all.push_back(numbers("body", now.body, Type::whole));
  all.push_back(numbers("material", now.material, Type::whole));
  all.push_back(numbers("held", now.clamped, Type::flag));
  all.push_back(ids(now.size()));
  all.push_back({"mass", now.dim == 3 ? "kg" : "kg/m", now.m});
  all.push_back(volumes(now));
  all.push_back(vectors("initial_position", "m", now.x0, now.dim));
  all.push_back(displacements(now));
  std::ranges::move(last, std::back_inserter(all));
  return all;
}

}  // namespace taut::cli
