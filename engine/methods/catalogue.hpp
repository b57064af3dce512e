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

/// A law of elasticity that a user may choose for a method.
struct LawChoice {
  std::string_view name;          // "st-venant-kirchhoff"
  std::string_view material_law;  // the reference to compare with
  Law law;
};

/// Meaning of the strain energy that a run reports.
enum class StrainEnergy {
  potential,  // of the forces: a change of the total energy is dissipated or created by the method
  of_stress,  // of a stress from its rate, which is no potential of the forces
  recovered,  // of a stress that is recovered for display and that no force uses
};
StrainEnergy strain_energy(const Formulation& m);

/// Description of a method for `list` and `describe`, derived from its Formulation.
struct MethodInfo {
  const Formulation& formulation;
  std::string_view name;
  std::string_view paper;
  std::string_view summary;
  std::string_view material_law;  // the reference to compare with: "2d_deviator" or "neo_hookean"
  std::vector<LawChoice> laws;    // of elasticity, which may be chosen; the first is the published one
  Law law;                        // the published one; none: the stress follows from its rate
  std::string_view conserves;
  std::vector<TermInfo> terms;
  std::vector<MethodConstant> constants;  // in 2D
  double cfl;                             // default acoustic CFL number
  ContactLaw contact;                     // the published one
  std::vector<ContactLaw> contact_laws;   // those that the method can run with
  bool keeps_neighbors;                   // see FamilyRow; contact then acts between parts of one body, too
  bool several_materials;                 // in one scene
};

/// Every method by name, in the order in which they are listed.
std::span<const MethodInfo> methods();
/// nullptr if there is none of that name.
const MethodInfo* find_method(std::string_view name);
/// The constants that a user may set, with their defaults in this dimension.
std::vector<MethodConstant> method_constants(const Formulation& m, int dim);
/// Those of the settings, and for the rest their defaults, with the spacing `dp`, m.
ConstantValues constant_values(const Formulation& m, int dim, double dp, const Settings& settings);

/// Every law of elasticity.
std::span<const LawRow> laws();
/// The one that the method runs with; nullptr for a method without one. Throws UsageError for a law that the
/// method does not have.
const LawRow* law_row(const MethodInfo& method, const Settings& settings);
/// Why the method cannot run with the law of this name (LawRow::choice); empty where it can.
std::string reason_against_law(const MethodInfo& method, std::string_view law);
/// The reference to compare a run with these settings with. Throws UsageError for a law that the method does
/// not have.
std::string_view material_law(const MethodInfo& method, const Settings& settings, int dim = 2);
/// Every law of contact, in the order in which they are offered.
std::span<const ContactLawRow> contact_rows();
/// How the bodies of the scene act on each other with this method, never `published`. Throws SceneError for a
/// law that the method cannot run with.
ContactLaw contact_law(const Scene& scene, const MethodInfo& method);
/// How they do under `published`: by the law of the method, or by the penalty where that is `surface` and the
/// scene has bodies without faces.
ContactLaw published_contact(const Scene& scene, const MethodInfo& method);

}  // namespace taut
