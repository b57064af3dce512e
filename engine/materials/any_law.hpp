#pragma once

#include <utility>
#include <variant>

#include "engine/materials/laws.hpp"

namespace taut::inline TAUT_ISA {

/// A law that is known at run time only. What it is asked for is a call of the law that it is, which is not inlined:
/// a solver is compiled once for all laws but its own.
class AnyLaw {
 public:
  AnyLaw() = default;
  AnyLaw(Law law, const Elasticity& e) { take(law, e, Laws{}); }

  /// `ask`(law) of the law that it is.
  template <class Ask>
  auto visit(const Ask& ask) const {
    return std::visit(
        [&](const auto& law) __attribute__((noinline)) { return ask(law); }, law_);
  }
  template <int Dim>
  Mat<double, Dim> piola(const Mat<double, Dim>& F, double J) const {
    return visit([&](const auto& law) { return law.piola(F, J); });
  }
  /// Of a law that takes_volume_ratio.
  template <int Dim>
  Mat<double, Dim> piola(const Mat<double, Dim>& F, const Mat<double, Dim>& H, double J) const {
    return visit([&](const auto& law) {
      if constexpr (requires { law.piola(F, H, J); })
        return law.piola(F, H, J);
      else
        return law.piola(F, J);
    });
  }
  template <int Dim>
  double energy(const Mat<double, Dim>& F, double J) const {
    return visit([&](const auto& law) { return law.energy(F, J); });
  }
  template <int Dim>
  Cauchy<Dim> cauchy(const Mat<double, Dim>& F, double J) const {
    return visit([&](const auto& law) { return law.cauchy(F, J); });
  }
  template <int Dim>
  double stiffness_bound(const Mat<double, Dim>& F, double J) const {
    return visit([&](const auto& law) { return law.stiffness_bound(F, J); });
  }

 private:
  template <Law... L>
  void take(Law law, const Elasticity& e, LawList<L...>) {
    ((law == L ? static_cast<void>(law_ = law_of<L>(e)) : void()), ...);
  }

  Laws::One law_;
};
template <>
struct LawOf<Law::any> : AnyLaw {
  using AnyLaw::AnyLaw;
};

/// The law `chosen`, which is L unless that is Law::any, with the numbers of a material.
template <Law L>
LawOf<L> law_of(Law chosen, const Elasticity& e) {
  if constexpr (L == Law::any)
    return {chosen, e};
  else
    return law_of<L>(e);
}

}  // namespace taut::inline TAUT_ISA
