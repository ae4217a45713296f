// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <span>

#include "physics/body/exact_distance.h"

namespace furrow::bench {

/// Signed distances of a body, sampled once and interpolated since: what the chart of fields compares.
class SampledField {
 public:
  virtual ~SampledField() = default;
  /// Sets `result[i]` for x[i]. Beyond the band only the sign means something.
  virtual void at_many(std::span<const physics::Vec3> x, std::span<physics::SignedDistance> result) const = 0;
  /// Gives the values alone, where they cost less than with gradients; false: they cannot be had so.
  virtual bool values(std::span<const physics::Vec3> /*x*/, std::span<double> /*result*/) const {
    return false;
  }
  virtual std::size_t memory() const = 0;  ///< [bytes]
};

/// The band in which distances are wanted [m]: how far from the surface, outside and inside.
struct Band {
  double outer = 0.03, inner = 0.02;
};

/// The plain way: one array of floats over the box of the body and its band. It is exact at the nodes that
/// the band needs (blocks of 8 x 8 x 8 nodes beyond it cost one distance), and gives value and gradient of
/// the trilinear interpolation.
std::unique_ptr<SampledField> uniform_grid(const physics::TriangleMesh& mesh, double cell, const Band& band);

/// OpenVDB's narrow-band level set by meshToSignedDistanceField on one thread. Its band is widened by what a
/// cell needs; without a band it has three voxels to each side, as meshToLevelSet does. Values are by
/// BoxSampler, with gradients by BoxStencil. Null where OpenVDB was not found.
std::unique_ptr<SampledField> openvdb_field(const physics::TriangleMesh& mesh, double voxel,
                                            const Band* band);

}  // namespace furrow::bench
