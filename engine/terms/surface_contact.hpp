#pragma once

#include <algorithm>

#include "engine/core/pack.hpp"
#include "engine/methods/term_info.hpp"

namespace taut::inline TAUT_ISA {

/// Pressure per depth between two faces, Pa/m, of two materials whose moduli of compression are M = K + 4G/3:
/// k = ½ s M1 M2/(M1 + M2)/dp. With s = 2 faces under a pressure p overlap by as much as it presses a layer
/// of two spacings of the material. Stiffer is nearer to the truth, which has no overlap, and would ask for
/// shorter steps: the fastest motion of two faces of `oenog`, whose outermost particles weigh 3/2 and −1/2 in
/// a node, has ω = 2.1 c_p/dp for s = 2, 2.6 for 4 and 3.1 for 6, which is where its steps of 0.64 dp/c_p end
/// to be stable. The energy of two rings that collide undamped drifts by 0.1 % for 2 at 2 mm, by 0.5 % for 4.
/// Symmetric to the last bit.
inline double surface_stiffness(double M1, double M2, double stiffness, double dp) {
  const double softer = std::min(M1, M2), harder = std::max(M1, M2);
  return 0.5 * stiffness * (softer * (harder / (softer + harder))) / dp;
}

/// J (per metre depth in 2D), of a piece of a face, m (m² in 3D), that lies `depth`, m, behind another face:
/// ½ · ½ k δ² A. Of two faces that overlap each is seen from the other, and each counts for half.
inline double surface_energy(double depth, double area, double k) {
  return depth > 0 ? 0.25 * k * area * depth * depth : 0;
}

/// Its slope, N (per metre depth in 2D), ½ k δ A: it pushes the piece to the nearest point of the other face
/// and the other face back, 0 where they do not overlap. So it never pulls.  Ours
inline double surface_force(double depth, double area, double k) {
  return depth > 0 ? 0.5 * k * area * depth : 0;
}
inline constexpr TermInfo surface_contact_info{
    "contact",
    "f = ½ k δ A on a node δ behind a face of another body, k = ½ s M1 M2/(M1 + M2)/dp, M = K + 4G/3", "ours",
    "terms/surface_contact.hpp:surface_force",
    "surface contact: none before faces meet, and the slope of its energy"};

/// Share of a piece of a face that counts, of the cosine between its outward normal and that of the face it
/// lies behind: all of it up to 60° from facing it, none from 76° on. At a corner one side meets a face and
/// the other one, at 90° or a little less once it is strained, does not.
inline double facing_share(double cosine) { return std::clamp(-4 * cosine - 1, 0.0, 1.0); }

}  // namespace taut::inline TAUT_ISA
