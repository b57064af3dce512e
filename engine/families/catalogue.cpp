#include "engine/families/catalogue.hpp"

#include <algorithm>
#include <array>

#include "engine/families/all_methods.hpp"
#include "engine/families/describe.hpp"

namespace taut {
namespace {

std::vector<TermInfo> terms(const Formulation& m) {
  switch (m.shear) {
    case Shear::bonds:
      return bonded_terms();
    case Shear::cauchy_stress:
      return cauchy_stress_terms(m);
    case Shear::reference_stress:
      return total_lagrangian_terms(m);
    default:
      return updated_lagrangian_terms(m);
  }
}

std::vector<MethodConstant> constants(const Formulation& m) {
  switch (m.shear) {
    case Shear::bonds:
      return bonded_constants(m);
    case Shear::cauchy_stress:
      return cauchy_stress_constants(m);
    case Shear::reference_stress:
      return total_lagrangian_constants(m);
    default:
      return updated_lagrangian_constants(m);
  }
}

/// Walls are every method's.
std::vector<TermInfo> with_wall(std::vector<TermInfo> t) {
  t.push_back({"wall", "as the own mirror image by the law of contact, sph: by the penalty", "ours",
               "solver/wall_contacts.hpp:WallContacts", "wall: a body meets its mirror image"});
  return t;
}

/// Those that every method has.
std::vector<MethodConstant> with_contact(std::vector<MethodConstant> c, const Formulation& m) {
  c.push_back({"contact_stiffness", m.contact_stiffness, 0.01, 100.0,
               "stiffness of a contact by forces over K1 K2/(K1 + K2): 1 as published, 2 as the material"});
  return c;
}

/// Bonds act between neighbours of the start, not on what comes near.
std::vector<ContactLaw> contact_laws(const Formulation& m) {
  if (m.shear == Shear::bonds || m.shear == Shear::reference_stress)
    return {ContactLaw::penalty, ContactLaw::impulse, ContactLaw::lennard_jones};
  return {ContactLaw::sph, ContactLaw::impulse, ContactLaw::penalty, ContactLaw::lennard_jones};
}

/// In the order of free_laws.
std::vector<LawChoice> laws(const Formulation& m) {
  if (!m.free_law) return {};
  return {{"neo-hookean", "neo_hookean"},
          {"st-venant-kirchhoff", "st_venant_kirchhoff"},
          {"linear", "linear_elastic"}};
}

MethodInfo info(const Formulation& m) {
  return {
      .name = m.name,
      .paper = m.paper,
      .summary = m.summary,
      .material_law = m.deviator == Deviator::in_plane ? "2d_deviator" : "neo_hookean",
      .laws = laws(m),
      .conserves = m.conserves,
      .terms = with_wall(terms(m)),
      .constants = with_contact(constants(m), m),
      .cfl = m.cfl,
      .contact = m.contact,
      .contact_laws = contact_laws(m),
      .several_materials = m.several_materials,
  };
}

template <const Formulation&... M>
auto table(MethodList<M...>) {
  return std::array{info(M)...};
}

}  // namespace

TermInfo penalty_term() {
  return {"contact", "f = s K1 K2/(K1 + K2) dp^(d−2) (dp − r) between bodies", "[TranDuc2023] Eq. 2.13",
          "terms/penalty_contact.hpp:penalty_force",
          "penalty contact: none from one spacing on, and the slope of its energy"};
}

TermInfo lennard_jones_term() {
  return {"contact", "f = s/2 K1 K2/(K1 + K2) dp^d (l⁶ − l⁴)/r, l = dp/r ≥ 1, between bodies",
          "[Zhang2020] Eq. 12", "terms/lennard_jones_contact.hpp:lennard_jones_force",
          "Lennard-Jones contact: none from one spacing on, and the slope of its energy"};
}

TermInfo impulse_term() {
  return {"contact", "Δ(m_i v_i) = m_i m_j/(m_i + m_j) · closing speed, between bodies, r < dp",
          "[Khayyer2024] Eq. 53, 54", "terms/impulse_contact.hpp:stopping_impulse",
          "impulse contact: stops the approach of a pair, nothing else"};
}

std::span<const MethodInfo> methods() {
  static const auto all = table(Methods{});
  return all;
}

const MethodInfo* find_method(std::string_view name) {
  const auto all = methods();
  const auto it = std::find_if(all.begin(), all.end(), [&](const MethodInfo& m) { return m.name == name; });
  return it == all.end() ? nullptr : &*it;
}

}  // namespace taut
