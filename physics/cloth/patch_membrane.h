// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "physics/cloth/cloth.h"
#include "physics/cloth/packed_energy.h"

namespace furrow::physics {

struct PatchOptions {
  double triangle_share = 0.05;  ///< alpha: what triangles keep of their own energy [-]; in (0, 1]
  double most_defect = 0.5;      ///< of a fan that becomes a patch, by its rest angles [rad]; >= 0
};

/// The fans of membrane triangles around vertices, each with one strain: the mean of its triangles' by area,
/// in axes of the fan unfolded,  E = sum of share times d,  d = l^2 - L^2 of its edges (Voigt: E11, E22,
/// 2 E12), and the energy  1/2 sum E^T stiffness E.  Constant.
struct Patches {
  struct Edge {
    int a, b;        ///< particles, a < b
    double length2;  ///< L^2 [m^2]
  };
  std::vector<Edge> edges;                 ///< sorted by (a, b)
  std::vector<int> begin;                  ///< of each patch its first entry below, and the end
  std::vector<int> edge;                   ///< of each entry
  std::vector<Eigen::Vector3d> share;      ///< of each entry [1/m^2]
  std::vector<Eigen::Matrix3d> stiffness;  ///< of each patch: (1 - alpha) A_v C [N m]; semidefinite
  int size() const { return int(stiffness.size()); }
};

/// Patches as an energy of a cloth. The tension of an edge is tau = dE/dd, its force 2 tau (x_b - x_a); the
/// stiffness is J^T A C J of each patch, J = dE/dx, which couples seven particles, and 2 tau on edges, in the
/// positive part 2 max(tau, 0). Stiffness::narrow changes nothing. Energy, total force and moment behave
/// under rigid motions as those of triangles do; sums have one order.
class PatchMembrane : public Energy {
 public:
  /// particles: how many the cloth has. Cost: a sort of some 28 pairs of particles a patch. Throws
  /// std::invalid_argument if an edge names a particle out of range.
  PatchMembrane(Patches patches, std::size_t particles);

  double energy(std::span<const Vec3> x) const override;
  void add_forces(std::span<const Vec3> x, std::span<Vec3> force) const override;
  double add_energy_and_forces(std::span<const Vec3> x, std::span<Vec3> force) const override;
  std::shared_ptr<const PackedEnergy> packed(std::span<const int> place) const override;
  bool add_stiffness(std::span<const Vec3> x, Stiffness stiffness, const BlockSink& sink) const override;

  const Patches& patches() const { return patches_; }
  /// The same with a stiffness divided by `times` (> 0). O(patches).
  std::shared_ptr<PatchMembrane> softened(double times) const;

 private:
  void find_pattern();
  void add_strain_blocks(std::span<const Vec3> x, std::vector<Mat3>& blocks) const;
  void add_tension_blocks(std::span<const Vec3> x, Stiffness stiffness, std::vector<Mat3>& blocks) const;

  Patches patches_;
  std::vector<std::array<int, 2>> pairs_;           ///< blocks of K on and below the diagonal
  std::vector<int> corners_;                        ///< of each patch how many particles
  std::vector<std::array<unsigned char, 2>> ends_;  ///< of each entry's edge, among those
  std::vector<int> place_;                          ///< of each patch's blocks, row by row
  std::vector<std::array<int, 3>> edge_place_;      ///< of (a, a), (b, a) and (b, b)
};

struct PatchCount {
  int patches = 0;  ///< vertices that have one
  int plain = 0;    ///< vertices of the membrane whose triangles stay as they are
};
/// Takes 1 - alpha of the membrane's energy off its triangles, a third of each at a corner, and gives it to
/// patches around the vertices (stabilised nodal strain), as a PatchMembrane behind Cloth::energies:
/// triangles of constant strain lock where a fine fold bends them, patches do not. Uniform strain has the
/// same energy. Triangles with three held corners stay out of patches: set pins first. A vertex stays plain,
/// its triangles' thirds whole, where its triangles are no single fan (edges of three faces, two fans that
/// touch), where lengths of an edge differ between triangles or materials do by more than a tenth, beside
/// triangles lower than 1e-4 of their longest edge, and where the rest angles around an inner vertex miss 2
/// pi by more than most_defect; up to that they are scaled to it. \details Dashpots know triangles alone, so
/// motion is damped by alpha of what it was. Prestress refuses it, as any energy; XPBD, too. Cost: a sort of
/// the edges. Throws std::invalid_argument, nothing changed, if an option is out of its range, and as
/// check_elements(). Source: Dohrmann et al. 2000, Node-based uniform strain elements, IJNME 47; Puso and
/// Solberg 2006, A stabilized nodally integrated tetrahedral, IJNME 67.
PatchCount join_patches(Cloth& cloth, const PatchOptions& options = {});

/// Divides the stiffness of a cloth's triangles and patches. O(elements). Throws std::invalid_argument if
/// `times` is not > 0.
void soften_membrane(Cloth& cloth, double times);

}  // namespace furrow::physics
