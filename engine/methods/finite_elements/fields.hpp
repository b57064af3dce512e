#pragma once

#include "engine/core/tensor.hpp"
#include "engine/layout/reference_element.hpp"
#include "engine/materials/chosen_laws.hpp"

namespace taut {

/// Geometry of four elements at a Gauss point.
template <int Dim, int modes>
struct ElementPoint {
  Mat<Pack, Dim> to_local;                 // ∂ξ/∂X, 1/m
  alignas(sizeof(Pack)) Pack weight;       // m^Dim
  alignas(sizeof(Pack)) Pack mode[modes];  // orthonormal functions that span the volume ratio, m^(−Dim/2)
};

constexpr int volume_modes(int order, int dim) { return order == 1 ? 1 : dim + 1; }

template <int Dim>
struct FiniteElementFields {
  using V = Vec<double, Dim>;

  int size;    // nodes
  int groups;  // of four elements
  V* x;
  const V *v, *X;
  V* u;                 // x − X, m
  const int* node;      // [group][local node][lane]
  const int* material;  // [element]
  const void* points;   // ElementPoint [group][Gauss point]
  // [group] λ/ρ0, m/kg; λ: greatest eigenvalue of the Laplacian of the element
  const Vec<Pack, 1>* rate;
  double* force;                 // [group][local node][component][lane], N
  const int *begin, *slot;       // slot[begin[i]] …: indices in `force` of node i
  const Vec<Pack, 1>* mobility;  // [group of nodes] 1/kg, 0 where clamped
  LawsInUse laws;
};

}  // namespace taut
