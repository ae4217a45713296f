// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "physics/cloth/cloth.h"
#include "physics/plate/plate.h"
#include "physics/plate/plate_forces.h"

namespace furrow::physics {

/// What couple_hinges() made a plate of, so that it can be made anew (physics/plate/recouple.h).
struct PlateOrigin {
  PlateRigidity rigidity;
  std::vector<double> warp;                         ///< as PlateOptions
  std::vector<std::array<double, 3>> rest_lengths;  ///< of the cloth's triangles [m]
  std::vector<char> apart;                          ///< of each hinge of the sheet; empty: none
  std::vector<double> press;                        ///< of each hinge of the sheet [-]
  std::vector<int> coupled, plain;                  ///< those of the plate, in its order, and of the cloth
};

/// A plate as an energy of a cloth: E = 1/2 sum k^T A D k (k less what it is at rest), k linear in the
/// hinges' bends. Forces follow from the hinges' moments m = dE/dtheta; the stiffness is G^T Q G + sum m
/// d2theta/dx2 with the gradients G of the angles, its positive part the first term (Gauss and Newton's).
/// With Stiffness::narrow Q is its diagonal: what hinges couple, and 0.2 to 2.3 times as stiff on garments.
/// Energy, total force and moment behave under rigid motions as those of hinges do; sums have one order.
class PlateBending : public Energy {
 public:
  /// Throws std::invalid_argument as check(Hinge) if a hinge names a particle out of range. Cost: a sort of
  /// some 60 pairs of particles a triangle.
  PlateBending(Plate plate, std::size_t particles, std::shared_ptr<const PlateOrigin> origin = nullptr);
  /// The same hinges and triangles as another's, pressed or at rest otherwise: without that sort. Throws
  /// std::invalid_argument if they are not.
  PlateBending(Plate plate, const PlateBending& like, std::shared_ptr<const PlateOrigin> origin);
  /// Whether the other plate has the same hinges and triangles.
  bool joins_as(const Plate& other) const;

  double energy(std::span<const Vec3> x) const override;
  void add_forces(std::span<const Vec3> x, std::span<Vec3> force) const override;
  double add_energy_and_forces(std::span<const Vec3> x, std::span<Vec3> force) const override;
  std::shared_ptr<const PackedEnergy> packed(std::span<const int> place) const override;
  bool add_stiffness(std::span<const Vec3> x, Stiffness stiffness, const BlockSink& sink) const override;

  /// k of each triangle at x [1/m].
  std::vector<Eigen::Vector3d> curvatures(std::span<const Vec3> x) const;
  /// Puts each triangle at rest at this k [1/m], one a triangle. Throws std::invalid_argument
  /// for another number of them.
  void put_at_rest(std::vector<Eigen::Vector3d> curvature);
  /// dE/dtheta of each hinge of the plate at x [N m].
  std::vector<double> moments(std::span<const Vec3> x) const;
  /// The same that these bends, one a hinge [rad], call forth; adds their energy [J].
  std::vector<double> moments_of(const std::vector<double>& bend, double& energy) const;
  const Plate& plate() const { return plate_; }
  /// Null: it was not made by couple_hinges().
  const std::shared_ptr<const PlateOrigin>& origin() const { return origin_; }

 private:
  struct Bends;
  /// Which blocks of K there are, on and below the diagonal, and which of them a triangle and a hinge fill.
  struct Pattern {
    std::vector<std::array<int, 2>> pairs;
    std::vector<int> corners;  ///< how many particles move each triangle's curvature
    std::vector<std::array<unsigned char, 4>> corner_of_entry;
    std::vector<int> place;                        ///< of each triangle's blocks, row by row
    std::vector<std::array<int, 10>> hinge_place;  ///< of each hinge's blocks
  };
  static std::shared_ptr<const Pattern> find_pattern(const Plate& plate);
  std::vector<double> stiffness_alone() const;
  void add_curvature_blocks(const std::vector<std::array<Vec3, 4>>& gradient,
                            std::vector<Mat3>& blocks) const;
  void hand_out_hinges(std::span<const Vec3> x, Stiffness stiffness, const BlockSink& sink) const;

  Plate plate_;
  PlateLayout layout_;
  std::shared_ptr<const PlateOrigin> origin_;
  std::shared_ptr<const Pattern> pattern_;  ///< not changed, and shared by copies
  std::vector<double> alone_;               ///< d2E/dbend2 of each hinge alone [N m]
};

/// How many hinges of a cloth became a plate, and how many stayed.
struct CoupledHinges {
  int coupled = 0, plain = 0, slivers = 0;
};
/// Hinges of the plates among a cloth's energies.
int count_coupled(const Cloth& cloth);
/// Takes the hinges of a cloth that a plate can have out of it and puts a PlateBending of them behind its
/// energies; the others stay, with the stiffness that they have. rest_lengths: of cloth.triangles. Pins must
/// be set, and stiffen_clamps() called if plain hinges are to be clamped: a plate knows its clamps by itself.
/// Nothing happens if none can be coupled.
/// Throws std::invalid_argument, nothing changed, as make_plate(), and if the hinges' law is not linear.
CoupledHinges couple_hinges(Cloth& cloth, std::span<const std::array<double, 3>> rest_lengths,
                            const PlateOptions& options, std::span<const char> apart = {},
                            std::span<const double> press = {});

}  // namespace furrow::physics
