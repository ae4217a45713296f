// SPDX-License-Identifier: GPL-3.0-or-later
// The peer of the chart of fields. The only source that knows OpenVDB; null without it.
#include "bench/charts/sampled_field.h"

#ifdef FURROW_WITH_OPENVDB
#include <openvdb/math/Stencils.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>
#include <tbb/global_control.h>

#include <cmath>
#endif

namespace furrow::bench {

#ifdef FURROW_WITH_OPENVDB
namespace {

using physics::SignedDistance;
using physics::Vec3;

class OpenvdbField : public SampledField {
 public:
  OpenvdbField(const physics::TriangleMesh& mesh, double voxel, const Band* band) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    openvdb::initialize();
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec3I> triangles;
    for (const Vec3& x : mesh.vertices) points.emplace_back(float(x[0]), float(x[1]), float(x[2]));
    for (const auto& [a, b, c] : mesh.triangles) triangles.emplace_back(a, b, c);
    // The corners of a cell lie up to its diagonal beyond the point.
    const double corner = std::sqrt(3.0);
    const double outer = band ? std::max(3.0, band->outer / voxel + corner) : 3;
    const double inner = band ? std::max(3.0, band->inner / voxel + corner) : 3;
    grid_ = openvdb::tools::meshToSignedDistanceField<openvdb::FloatGrid>(
        *openvdb::math::Transform::createLinearTransform(voxel), points, triangles, {}, float(outer),
        float(inner));
  }

  void at_many(std::span<const Vec3> x, std::span<SignedDistance> result) const override {
    openvdb::math::BoxStencil<openvdb::FloatGrid> stencil(*grid_);
    const double cells_a_metre = 1 / grid_->voxelSize()[0];
    for (std::size_t i = 0; i < x.size(); ++i) {
      const openvdb::Vec3d at = openvdb::Vec3d(x[i][0], x[i][1], x[i][2]) * cells_a_metre;
      stencil.moveTo(at);
      const openvdb::Vec3s place(at), gradient = stencil.gradient(place);
      result[i] = {stencil.interpolation(place), Vec3(gradient[0], gradient[1], gradient[2])};
    }
  }
  bool values(std::span<const Vec3> x, std::span<double> result) const override {
    const auto access = grid_->getConstAccessor();
    const openvdb::tools::GridSampler<openvdb::FloatGrid::ConstAccessor, openvdb::tools::BoxSampler> sampler(
        access, grid_->transform());
    for (std::size_t i = 0; i < x.size(); ++i) result[i] = sampler.wsSample({x[i][0], x[i][1], x[i][2]});
    return true;
  }
  std::size_t memory() const override { return grid_->memUsage(); }

 private:
  openvdb::FloatGrid::Ptr grid_;
};

}  // namespace

std::unique_ptr<SampledField> openvdb_field(const physics::TriangleMesh& mesh, double voxel,
                                            const Band* band) {
  return std::make_unique<OpenvdbField>(mesh, voxel, band);
}
#else
std::unique_ptr<SampledField> openvdb_field(const physics::TriangleMesh&, double, const Band*) {
  return nullptr;
}
#endif

}  // namespace furrow::bench
