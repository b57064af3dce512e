#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "engine/materials/laws.hpp"

namespace taut {

template <const auto& M, Law L>
constexpr bool may_run_with = L == M.law || may_be_given(M, LawOf<L>::row);

/// The materials may differ if `several`.
template <class L, bool several = true>
struct LawsOfFour {
  const L* laws;         // [material]
  const int* materials;  // [particle]

  template <class F>
  [[gnu::always_inline]] auto operator()(int group, const F& f) const {
    const int* const of = materials + static_cast<std::ptrdiff_t>(lanes) * group;
    if constexpr (several)
      if (of[0] != of[1] || of[0] != of[2] || of[0] != of[3]) [[unlikely]]
        return mixed(of, f);
    return f(laws[of[0]]);
  }

 private:
  template <class F>
  [[gnu::noinline]] auto mixed(const int* of, const F& f) const {
    auto all = f(laws[of[0]]);
    for (int lane = 1; lane < lanes; ++lane) take_lane(all, lane, f(laws[of[lane]]));
    return all;
  }
};

struct LawsInUse {
  Law law;
  const void* laws;  // LawOf<law> [material]

  template <const auto& M, class Pass>
  auto visit(const Pass& pass) const {
    return visit_among<M>(pass, Laws{});
  }

 private:
  template <const auto& M, class Pass, Law First, Law... Rest>
  auto visit_among(const Pass& pass, LawList<First, Rest...>) const {
    if constexpr (may_run_with<M, First>)
      if (law == First) return pass(static_cast<const LawOf<First>*>(laws));
    if constexpr (sizeof...(Rest) > 0 && (may_run_with<M, Rest> || ...))
      return visit_among<M>(pass, LawList<Rest...>{});
    else
      __builtin_unreachable();
  }
};

class Materials {
 public:
  Materials(Law law, const std::vector<Elasticity>& materials) : law_(law) { take(materials, Laws{}); }

  /// J instead of det F, [Lee2016] Eq. 8.
  void take_volume_ratio_in_shear() {
    const auto take = [](auto& law) {
      if constexpr (requires { law.J_in_shear; }) law.J_in_shear = true;
    };
    std::visit([&](auto& laws) { std::ranges::for_each(laws, take); }, laws_);
  }
  LawsInUse in_use() const {
    return {law_, std::visit([](const auto& laws) -> const void* { return laws.data(); }, laws_)};
  }
  template <class F>
  auto visit(int material, const F& f) const {
    return std::visit([&](const auto& laws) { return f(laws[static_cast<std::size_t>(material)]); }, laws_);
  }

 private:
  template <Law... L>
  void take(const std::vector<Elasticity>& materials, LawList<L...>) {
    const auto take_one = [&]<Law One>() {
      if (One != law_) return;
      std::vector<LawOf<One>> own;
      for (const Elasticity& material : materials) own.push_back(law_of<One>(material));
      laws_ = std::move(own);
    };
    (take_one.template operator()<L>(), ...);
  }

  Law law_;
  Laws::Each laws_;
};

}  // namespace taut
