#pragma once

#include <vector>

#include "engine/families/bonded/bonds.hpp"
#include "engine/scene/initial_particles.hpp"

namespace taut {

/// Makes a homogeneous strain leave no force inside a body, whatever its layout, by the least change of the
/// vectors a_ij and of the weights w_ij that does so; on a lattice, where none is left anyway, by none.
///
/// Under a homogeneous displacement gradient H all stresses P are the same, and the force on i is
///   P Σ_j (V_i g_ij − V_j g_ji) + Σ_j G (V_i w_ij + V_j w_ji) (e·H e) e/r_ij − Σ_j (C_i g_ij − C_j g_ji),
///   C_i = V_i G Σ_j w_ij (e·H e) e ⊗ e:
/// the first term of the stress, the others of the bonds and of what is cancelled of them. The areas make the
/// first 0 and leave the Σ_j a_ij ⊗ X_ij as they were; then the weights the rest, which is linear in the
/// weights, for the three strains of the plane, with the gradients that there are then. Both at each
/// particle that is inside: neither it nor one that it is bonded to is at a surface or held. Nearer to one
/// the first term is the surface's share, which a traction balances. Of a body whose layout a turn maps onto
/// itself (InitialParticles::turned) one sector is solved for: of an aligned ring one particle a layer.
///
/// Of an irregular body (bonds.hpp) weights are balanced at each particle that is not itself at a surface or held,
/// and of the first term of those nearer to one the part along the face is made 0 where the face is flat: what
/// is left there pushes across it, as a traction does, and not along it.
///
/// Where an a_ij would change by more than six times itself, all of the body are left as they are: the gradients that
/// balance them are steep, steps short and volumes negative. Of an irregular body where that is more than 2.25, as
/// of particles jittered by 0.15 dp and more, all change by (2.25/that)² of it: by all of it the body would fly apart.
///
/// That is the force of first order in H. Of the second order a rest is left where a bond has no counterpart
/// on the other side; on an aligned ring it falls with dp².
void balance(const InitialParticles& initial, const std::vector<bool>& irregular, Bonds& bonds, int threads);

}  // namespace taut
