#include "engine/solver/initial_configuration.hpp"

#include <algorithm>
#include <span>
#include <string>

#include <fmt/core.h>

#include "engine/error.hpp"
#include "engine/kernels/kernel.hpp"

namespace taut {
namespace {

/// Limit of tr M tr M⁻¹, M of `gradient_correction`, for a particle and all its neighbours. Bent or jittered rows and
/// layers one particle thick exceed it and diverge. Lattices have 4 in 2D and 9 in 3D, at most 21 if two particles thick.
constexpr double greatest_condition = 33;

}  // namespace

double initial_support(const SolverInput& input) {
  return with_kernel(input.method.kernel, [](auto kernel) { return kernel.support; }) * input.constants.h;
}

template <int Dim>
InitialConfiguration<Dim>::InitialConfiguration(Common<Dim>& common, const SolverInput& input,
                                                GradientCorrection gradient, double normalised,
                                                bool corrected_forces)
    : materials(input.law, input.materials), common_(common) {
  const Particles<Dim>& p = common.particles;
  const InitialParticles& initial = common.initial;
  const double h = common.constants.h;
  X = p.x;
  V0 = initial.V0;
  const int group_count = (p.size() + lanes - 1) / lanes;
  material = initial.material;
  material.resize(static_cast<std::size_t>(lanes) * group_count, material.back());
  std::vector<double> cells;  // m^Dim
  for (int i = 0; i < p.size(); ++i) cells.push_back(V0[i] / initial.inside[i]);
  pairs = with_kernel(input.method.kernel, [&]<class K>(K) {
    return make_initial_pairs<K>(initial_neighbors(initial, reach_of_pairs<K>(h), input.threads), X, cells, h,
                                 gradient, normalised, input.threads);
  });
  check_pairs(input.scene, input.method);
  sites.assign(group_count, Sites<Dim>{});
  for (int i = 0; i < p.size(); ++i) {
    Sites<Dim>& of_four = sites[i / lanes];
    of_four.V0[i % lanes] = V0[i];
    of_four.per_m[i % lanes] = 1 / p.m[i];
    of_four.mobile[i % lanes] = p.mobile[i];
    for (int c = 0; c < Sym<double, Dim>::size; ++c) of_four.B.c[c][i % lanes] = pairs.B[i].c[c];
  }
  // with normalised gradients, loads act on the outermost layer, as in [Zhang2020]
  if (gradient == GradientCorrection::corrected)
    common.external.loads.act_on_faces(input.scene, initial, FaceRule::uniform, surface(corrected_forces),
                                       common.run.support);
  common.run.pairs = static_cast<long>(pairs.j.size());
  for (const int used : initial.material)
    wave_speed = std::max(wave_speed, compression_wave_speed(input.materials[used]));
  common.go_to_start();
  common.contact.search(p);
  common.show_contacts_to_probes();
}

template <int Dim>
void InitialConfiguration<Dim>::check_pairs(const Scene& scene, const Formulation& method) const {
  const auto& [begin, j, k, B] = pairs;
  std::vector<char> thin(X.size());
  for (std::size_t i = 0; i < X.size(); ++i) {
    double trace_M = 0;
    for (int p = begin[i]; p < begin[i + 1]; ++p) trace_M += dot(X[j[p]] - X[i], k[p]);
    thin[i] = trace_M * trace(B[i]) > greatest_condition;
  }
  for (std::size_t i = 0; i < X.size(); ++i) {
    const auto near = std::span(j).subspan(begin[i], begin[i + 1] - begin[i]);
    const bool in_row = thin[i] && std::ranges::all_of(near, [&](int n) { return thin[n]; });
    if (trace(B[i]) > 0 && !in_row) continue;
    const std::string& body = scene.bodies[common_.particles.body[i]].name;
    throw SceneError(
        "body." + body,
        fmt::format(
            "body '{}' is too thin for method '{}': the neighbours of one of its particles do not span the space; "
            "use a smaller spacing",
            body, method.name));
  }
}

/// Outward area vectors S_i by id, m^(Dim − 1); 0 inside a lattice.
template <int Dim>
std::vector<Point> InitialConfiguration<Dim>::surface(bool corrected_forces) const {
  const auto& [begin, j, k, B] = pairs;
  const std::vector<double>& inside = common_.initial.inside;
  std::vector<Point> S(X.size());
  for (std::size_t i = 0; i < X.size(); ++i) {
    V sum{};
    for (int p = begin[i]; p < begin[i + 1]; ++p)
      sum += corrected_forces ? (V0[i] * B[i] + V0[j[p]] * B[j[p]]) * k[p]
                              : (2 * inside[i] * inside[j[p]]) * k[p];
    for (int a = 0; a < Dim; ++a) S[i][a] = -sum[a];
  }
  return S;
}

template <int Dim>
double InitialConfiguration<Dim>::step_size() const {
  const Constants& c = common_.constants;
  return common_.fixed_or_stable_step(c.cfl * c.h / (wave_speed + common_.vmax));
}

template <int Dim>
void InitialConfiguration<Dim>::store(Snapshot& out, int i, const Mat<double, Dim>& F, double J) const {
  materials.visit(material[i], [&](const auto& law) {
    const auto [sigma, zz] = law.cauchy(F, J);
    const double p = -(trace(sigma) + zz) / 3;
    Sym<double, Dim> s = sigma;
    for (int k = 0; k < Dim; ++k) s(k, k) += p;
    common_.store(out, i, common_.particles.m[i] / (V0[i] * J), p, s, zz + p);
    out.strain_energy[common_.particles.id[i]] = V0[i] * law.energy(F, J);
  });
}

template <int Dim>
void InitialConfiguration<Dim>::store_motion(Snapshot& out, int i, const Mat<double, Dim>& F,
                                             double J) const {
  common_.store_motion(out, i);
  materials.visit(material[i], [&](const auto& law) {
    out.strain_energy[common_.particles.id[i]] = V0[i] * law.energy(F, J);
  });
}

template class InitialConfiguration<2>;
template class InitialConfiguration<3>;

}  // namespace taut
