#pragma once

#include <vector>

#include "engine/methods/description.hpp"
#include "engine/methods/formulation.hpp"

/// What `list` and `describe` say of the methods of one solver.
namespace taut {

std::vector<TermInfo> updated_lagrangian_terms(const Formulation& m);
std::vector<MethodConstant> updated_lagrangian_constants(const Formulation& m);

std::vector<TermInfo> bonded_terms();
std::vector<MethodConstant> bonded_constants(const Formulation& m);

std::vector<TermInfo> cauchy_stress_terms(const Formulation& m);
std::vector<MethodConstant> cauchy_stress_constants(const Formulation& m);

std::vector<TermInfo> total_lagrangian_terms(const Formulation& m);
std::vector<MethodConstant> total_lagrangian_constants(const Formulation& m);

/// Contact and time stepping, which several have.
TermInfo penalty_term();
TermInfo lennard_jones_term();
TermInfo impulse_term();

}  // namespace taut
