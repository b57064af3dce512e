#pragma once

#include "engine/core/tensor.hpp"

namespace taut {

/// Constants of four particles; 0 in the padding.
template <int Dim>
struct Sites {
  Sym<Pack, Dim> B;                   // 1/m^Dim
  alignas(sizeof(Pack)) Pack V0;      // m^Dim
  alignas(sizeof(Pack)) Pack per_m;   // 1/kg
  alignas(sizeof(Pack)) Pack mobile;  // 1, or 0 where clamped
};

}  // namespace taut
