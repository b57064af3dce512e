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

struct LawChoice {
  std::string_view name;
  std::string_view material_law;
  Law law;
};

enum class StrainEnergy {
  potential,  // function of the positions or F
  of_stress,  // of an integrated stress
  recovered,  // of a stress that is recovered for display
};
StrainEnergy strain_energy(const Formulation& m);

struct MethodInfo {
  const Formulation& formulation;
  std::string_view name;
  std::string_view paper;
  std::string_view summary;
  std::string_view material_law;  // of the reference solution
  std::vector<LawChoice> laws;    // the default first
  Law law;                        // none: a stress rate or shear acceleration is integrated
  std::string_view conserves;
  std::vector<TermInfo> terms;
  std::vector<MethodConstant> constants;  // in 2D
  double cfl;                             // default
  ContactLaw contact;                     // default; scene files call it `published`
  std::vector<ContactLaw> contact_laws;
  bool keeps_neighbors;  // if true, contact also acts within a body
  bool several_materials;
};

std::span<const MethodInfo> methods();
/// Returns nullptr for unknown names.
const MethodInfo* find_method(std::string_view name);
/// Defaults for `dim`.
std::vector<MethodConstant> method_constants(const Formulation& m, int dim);
/// Values in SI units; `dp` in m.
ConstantValues constant_values(const Formulation& m, int dim, double dp, const Settings& settings);

std::span<const LawRow> laws();
/// Elastic law of a run, or nullptr. Throws UsageError if the method lacks the chosen law.
const LawRow* law_row(const MethodInfo& method, const Settings& settings);
/// Reason why the method refuses the law; empty if it accepts it.
std::string reason_against_law(const MethodInfo& method, std::string_view law);
/// Law of the reference solution of a run. Throws UsageError if the method lacks the law.
std::string_view material_law(const MethodInfo& method, const Settings& settings, int dim = 2);
std::span<const ContactLawRow> contact_rows();
/// Never `published`. Throws SceneError if the method cannot use the scene's law.
ContactLaw contact_law(const Scene& scene, const MethodInfo& method);
/// Default; `penalty` instead of `surface` if bodies have no faces.
ContactLaw published_contact(const Scene& scene, const MethodInfo& method);

}  // namespace taut
