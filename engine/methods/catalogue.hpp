#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/materials/elastic_law.hpp"
#include "engine/materials/law_row.hpp"
#include "engine/methods/constants.hpp"
#include "engine/methods/formulation.hpp"
#include "engine/scene/scene.hpp"
#include "engine/settings.hpp"
#include "engine/solver/solver_input.hpp"
#include "engine/terms/contact_law_row.hpp"

namespace taut {

/// An elastic law available for a method.
struct LawChoice {
  std::string_view name;          // "st-venant-kirchhoff"
  std::string_view material_law;  // reference to compare with
  Law law;
};

/// Meaning of the reported strain energy.
enum class StrainEnergy {
  potential,  // of the forces; changes of total energy are then due to the method
  of_stress,  // of an integrated stress; not a potential
  recovered,  // of a stress recovered for display only
};
StrainEnergy strain_energy(const Formulation& m);

/// Description of a method for `list` and `describe`.
struct MethodInfo {
  const Formulation& formulation;
  std::string_view name;
  std::string_view paper;
  std::string_view summary;
  std::string_view material_law;  // reference to compare with: "2d_deviator" or "neo_hookean"
  std::vector<LawChoice> laws;    // available elastic laws; the published one first
  Law law;                        // published; none: the stress is integrated
  std::string_view conserves;
  std::vector<TermInfo> terms;
  std::vector<MethodConstant> constants;  // in 2D
  double cfl;                             // default acoustic CFL number
  ContactLaw contact;                     // published
  std::vector<ContactLaw> contact_laws;   // available
  bool keeps_neighbors;                   // see FamilyRow; if true, a body's parts can touch
  bool several_materials;                 // allowed in a scene
};

/// All methods, in listing order.
std::span<const MethodInfo> methods();
/// Returns nullptr for an unknown name.
const MethodInfo* find_method(std::string_view name);
/// User-settable constants with defaults.
std::vector<MethodConstant> method_constants(const Formulation& m, int dim);
/// Values from the settings or defaults. `dp`: m.
ConstantValues constant_values(const Formulation& m, int dim, double dp, const Settings& settings);

/// All elastic laws.
std::span<const LawRow> laws();
/// Law of the run; nullptr if none. Throws UsageError if unavailable for the method.
const LawRow* law_row(const MethodInfo& method, const Settings& settings);
/// Returns why the method cannot use this law (LawRow::choice); empty if it can.
std::string reason_against_law(const MethodInfo& method, std::string_view law);
/// Reference for the run. Throws UsageError if the law is unavailable for the method.
std::string_view material_law(const MethodInfo& method, const Settings& settings, int dim = 2);
/// All contact laws, in listing order.
std::span<const ContactLawRow> contact_rows();
/// Law of a run, never `published`. Throws SceneError if the method cannot use the scene's law.
ContactLaw contact_law(const Scene& scene, const MethodInfo& method);
/// Law for `published`: the method's, or `penalty` instead of `surface` if bodies have no faces.
ContactLaw published_contact(const Scene& scene, const MethodInfo& method);

}  // namespace taut
