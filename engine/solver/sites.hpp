#pragma once

#include "engine/core/tensor.hpp"

namespace taut {

/// Constants of a group of four particles; 0 in the padding of the last group.
template <int Dim>
struct Sites {
  Sym<Pack, Dim> B;                   // 1/m^Dim
  alignas(sizeof(Pack)) Pack V0;      // m^Dim
  alignas(sizeof(Pack)) Pack per_m;   // 1/kg (per metre depth in 2D)
  alignas(sizeof(Pack)) Pack mobile;  // 1, or 0 where clamped
};

}  // namespace taut
