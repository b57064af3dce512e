#include "engine/methods/catalogue.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "engine/contact/motion_bound.hpp"
#include "engine/contact/wall_contacts.hpp"
#include "engine/error.hpp"
#include "engine/layout/surface_mesh.hpp"
#include "engine/materials/laws.hpp"
#include "engine/methods/all_methods.hpp"
#include "engine/methods/families.hpp"
#include "engine/terms/contact_laws.hpp"

namespace taut {
namespace {

std::vector<TermInfo> terms(const Formulation& m) {
  std::vector<TermInfo> all = row_of(m.family).terms(m);
  for (TermInfo& term : all) {
    const auto own = std::ranges::find(m.citations, term.what, &Citation::what);
    if (own == m.citations.end()) continue;
    term.source = own->source;
    if (!own->test.empty()) term.test = own->test;
  }
  all.push_back(wall_info);
  if (row_of(m.family).keeps_neighbors) all.push_back(self_contact_info);
  return all;
}

/// `sph` requires a neighbour search, `surface` initial neighbours.
std::vector<ContactLaw> contact_laws_of(bool searches, bool of_elements) {
  if (of_elements) return {ContactLaw::surface};
  std::vector<ContactLaw> all;
  for (const ContactLawRow& row : contact_laws)
    if (row.between == ContactBetween::particles ||
        (row.between == ContactBetween::all_neighbors) == searches)
      all.push_back(row.law);
  if (!searches)  // simplest first
    std::ranges::stable_partition(all, [](ContactLaw law) { return law == ContactLaw::penalty; });
  return all;
}

bool needs_faces(ContactLaw law) { return contact_row(law).between == ContactBetween::faces; }

std::string joined(const std::vector<ContactLaw>& laws) {
  std::string names;
  for (const ContactLaw law : laws) names += (names.empty() ? "" : ", ") + std::string(law.name);
  return names;
}

std::vector<LawChoice> laws(const ElasticSwitches* m) {
  std::vector<LawChoice> all;
  if (!m) return all;
  for (const LawRow& row : Laws::rows)
    if (may_be_given(*m, row)) all.push_back({row.choice, row.material_law, row.law});
  std::stable_partition(all.begin(), all.end(),
                        [&](const LawChoice& choice) { return choice.law == m->law; });
  return all;
}

bool has_faces(const Scene& scene) { return scene.dim != 3 || can_have_surface_mesh(scene); }

MethodInfo info(const Formulation& m) {
  const FamilyRow& row = row_of(m.family);
  const ElasticSwitches* elastic = row.elastic(m);
  return {
      .formulation = m,
      .name = m.name,
      .paper = m.paper,
      .summary = m.summary,
      .material_law = m.deviator == Deviator::in_plane ? "2d_deviator" : "neo_hookean",
      .laws = laws(elastic),
      .law = elastic ? elastic->law : Law::none,
      .conserves = m.conserves,
      .terms = terms(m),
      .constants = method_constants(m, 2),
      .cfl = m.cfl,
      .contact = m.contact,
      .contact_laws = contact_laws_of(!row.keeps_neighbors, m.element_order > 0),
      .keeps_neighbors = row.keeps_neighbors,
      .several_materials = m.several_materials,
  };
}

std::vector<MethodInfo> table() {
  std::vector<MethodInfo> all;
  for (const Formulation* m : all_methods) all.push_back(info(*m));
  return all;
}

const LawChoice& chosen_law(const MethodInfo& method, const Settings& settings) {
  for (const LawChoice& choice : method.laws)
    if (settings.law.empty() || choice.name == settings.law) return choice;
  throw UsageError(reason_against_law(method, settings.law));
}

}  // namespace

std::span<const MethodInfo> methods() {
  static const auto all = table();
  return all;
}

StrainEnergy strain_energy(const Formulation& m) {
  const FamilyRow& row = row_of(m.family);
  if (row.keeps_neighbors) return StrainEnergy::potential;
  return row.carries_stress(m) ? StrainEnergy::of_stress : StrainEnergy::recovered;
}

const MethodInfo* find_method(std::string_view name) {
  const auto all = methods();
  const auto it = std::find_if(all.begin(), all.end(), [&](const MethodInfo& m) { return m.name == name; });
  return it == all.end() ? nullptr : &*it;
}

std::vector<MethodConstant> method_constants(const Formulation& m, int dim) {
  std::vector<MethodConstant> all = row_of(m.family).constants(m, dim);
  all.push_back(
      {"contact_stiffness", m.contact_stiffness, 0.01, 100.0,
       "contact stiffness relative to K1 K2/(K1 + K2), with `surface` to ½ M1 M2/(M1 + M2), M = K + 4G/3; "
       "1: as in [TranDuc2023], 2: as stiff as the material"});
  return all;
}

ConstantValues constant_values(const Formulation& m, int dim, double dp, const Settings& settings) {
  ConstantValues values;
  for (const MethodConstant& constant : method_constants(m, dim)) {
    const auto given = settings.constants.find(std::string(constant.name));
    const double value = given == settings.constants.end() ? constant.value : given->second;
    values[constant.name] = constant.in_spacings ? value * dp : value;
  }
  return values;
}

std::string_view material_law(const MethodInfo& method, const Settings& settings, int dim) {
  if (dim == 3 && method.laws.empty() && settings.law.empty())
    return "neo_hookean";  // in 3D the factor 1/d is the usual 1/3
  return method.laws.empty() && settings.law.empty() ? method.material_law
                                                     : chosen_law(method, settings).material_law;
}

const LawRow* law_row(const MethodInfo& method, const Settings& settings) {
  const Law law = method.laws.empty() && settings.law.empty() ? method.law : chosen_law(method, settings).law;
  return law == Law::none ? nullptr : &law_row(law);
}

std::string reason_against_law(const MethodInfo& method, std::string_view law) {
  std::string known;
  for (const LawChoice& choice : method.laws) {
    if (choice.name == law) return "";
    known += (known.empty() ? "" : ", ") + std::string(choice.name);
  }
  if (known.empty()) return fmt::format("the law of the method '{}' cannot be chosen", method.name);
  if (std::ranges::find(Laws::rows, law, &LawRow::choice) == Laws::rows.end())
    return fmt::format("method '{}' has no law '{}'; it has: {}", method.name, law, known);
  return fmt::format(
      "method '{}' has the volume ratio as a separate unknown and cannot run with the law '{}', "
      "a function of the deformation gradient alone; allowed laws: {}",
      method.name, law, known);
}

std::span<const LawRow> laws() { return Laws::rows; }

std::span<const ContactLawRow> contact_rows() { return contact_laws; }

ContactLaw published_contact(const Scene& scene, const MethodInfo& method) {
  return needs_faces(method.contact) && !has_faces(scene) ? ContactLaw::penalty : method.contact;
}

ContactLaw contact_law(const Scene& scene, const MethodInfo& method) {
  if (scene.contact == ContactLaw::published) return published_contact(scene, method);
  if (needs_faces(scene.contact) && !has_faces(scene)) {
    std::vector<ContactLaw> others = method.contact_laws;
    std::erase_if(others, needs_faces);
    throw SceneError(
        "contact",
        fmt::format("the contact law '{}' needs faces, "
                    "but in 3D a body whose particles are listed one by one has no faces; allowed: {}",
                    scene.contact.name, joined(others)));
  }
  if (std::ranges::find(method.contact_laws, scene.contact) != method.contact_laws.end())
    return scene.contact;
  const std::string_view reason =
      needs_faces(scene.contact)
          ? "faces need initial neighbours, but its particles can leave their neighbours"
      : method.formulation.element_order > 0
          ? "it acts between equal particles, but nodes differ in mass and distance"
          : "its particles act on their initial neighbours only";
  throw SceneError(
      "contact", fmt::format("method '{}' cannot run with the contact law '{}': {}; allowed: {}", method.name,
                             scene.contact.name, reason, joined(method.contact_laws)));
}

}  // namespace taut
