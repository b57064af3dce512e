#include <fmt/core.h>

#include "cli/scene/sections.hpp"
#include "cli/text/format.hpp"
#include "engine/methods/catalogue.hpp"

namespace taut::cli {
namespace {

/// An expression: in a resolved scene, K still depends on E and ν.
const std::string usual_bulk_modulus = "E/(3*(1 - 2*nu))";

void read_bulk_modulus(TomlCursor& cursor, Material& material) {
  constexpr std::string_view key = "bulk_modulus";
  if (!cursor.find(key)) cursor.table().set(std::string(key), TomlValue(usual_bulk_modulus));
  const TomlValue& value = *cursor.find(key);
  if (value.kind == TomlValue::Kind::text && value.text == usual_bulk_modulus) return;
  cursor.names()["E"] = material.youngs_modulus;
  cursor.names()["nu"] = material.poisson_ratio;
  material.given_bulk_modulus = cursor.number(key);
}

void read_law_parameters(TomlCursor& cursor, Material& material) {
  for (const LawRow& law : laws()) {
    for (const LawParameter& parameter : law.parameters) {
      if (!cursor.find(parameter.key)) continue;
      material.law_parameters[std::string(parameter.key)] = cursor.number(parameter.key);
    }
  }
}

Material read_material(TomlCursor cursor, const std::string& name) {
  if (const TomlValue& ratio = cursor.need("poisson_ratio"); cursor.value_of(ratio, "poisson_ratio") == 0.5)
    cursor.fail(
        ratio, "poisson_ratio",
        "poisson_ratio = 0.5 must be below 0.5: at 0.5 the bulk modulus would be infinite, so use 0.49 for rubber");
  Material material{.name = name,
                    .density = cursor.number("density"),
                    .youngs_modulus = cursor.number("youngs_modulus"),
                    .poisson_ratio = cursor.number("poisson_ratio")};
  read_bulk_modulus(cursor, material);
  read_law_parameters(cursor, material);
  cursor.finish();
  return material;
}

}  // namespace

void add_names(Names& names, const Material& material) {
  names["c0"] = material.sound_speed();
  names["E"] = material.youngs_modulus;
  names["nu"] = material.poisson_ratio;
  names["rho"] = material.density;
  names["K"] = material.bulk_modulus();
  names["G"] = material.shear_modulus();
}

void read_materials(TomlCursor& root, Scene& scene) {
  TomlCursor materials = root.enter(root.need("material"), "material", "[material]", named_by_user);
  for (TomlEntry& entry : materials.table().entries) {
    materials.find(entry.key);
    TomlCursor cursor =
        materials.enter(entry.value, entry.key, fmt::format("material '{}'", entry.key), keys_of("material"));
    scene.materials.push_back(read_material(std::move(cursor), entry.key));
  }
}

}  // namespace taut::cli
