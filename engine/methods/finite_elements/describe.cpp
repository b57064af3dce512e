#include "engine/methods/finite_elements/describe.hpp"

#include "engine/materials/laws.hpp"
#include "engine/methods/finite_elements/element.hpp"
#include "engine/terms/contact_laws.hpp"

namespace taut::finite_elements {
namespace {

constexpr TermInfo mass_info{
    "mass", "m_a = Σ_elements ρ0 V ω_a/Σ ω, ω: Gauss–Lobatto weight times det ∂X/∂ξ",
    "lumped and scaled to the mass of the element, as in HRZ lumping", "layout/element_mesh.cpp:add_volumes",
    "element mesh: the volume of each shape is exact or converges, and nodal volumes are positive"};
constexpr TermInfo step_info{
    "time step",
    "Δt = 2 cfl/√(max λ c² + ω²), ω: frequency of the contact spring while contact acts, "
    "λ: greatest eigenvalue of the Laplacian of an element",
    "ours; c²: bound of the squared wave speed in the strained element",
    "methods/finite_elements/solver.cpp:step_size",
    "finite elements: the default step is stable and at least a third of the critical step"};
constexpr TermInfo time_info{"time", "position Verlet, one step", "[Zhang2020] Eq. 10, 11",
                             "methods/finite_elements/solver.cpp:step",
                             "finite elements: a vibrating body keeps its energy"};

}  // namespace

std::vector<TermInfo> terms(const FiniteElementFormulation& m) {
  return {element_strain_info,     law_row(m.law).term, element_force_info, mass_info,
          contact_info(m.contact), step_info,           time_info};
}

std::vector<ConstantRow<FiniteElementConstants>> constants(const FiniteElementFormulation&, int) {
  return {};
}

}  // namespace taut::finite_elements
