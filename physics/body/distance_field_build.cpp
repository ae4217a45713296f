// SPDX-License-Identifier: MIT
#include <algorithm>
#include <stdexcept>

#include "physics/base/require.h"
#include "physics/body/distance_field.h"
#include "physics/body/distance_octree.h"

namespace furrow::physics {
namespace {

void check(const DistanceFieldOptions& o) {
  const auto check = [](const char* option, double value, bool good, const char* range) {
    require("DistanceFieldOptions", option, value, good, range);
  };
  if (o.tolerance) check("tolerance", *o.tolerance, *o.tolerance > 0, "> 0 [m]");
  check("outer_band", o.outer_band, o.outer_band >= 0 && o.outer_band <= 1e9, "in [0, 1e9] [m]");
  check("inner_band", o.inner_band, o.inner_band >= 0 && o.inner_band <= 1e9, "in [0, 1e9] [m]");
  check("far_slope", o.far_slope, o.far_slope >= 0 && o.far_slope <= 1, "in [0, 1]");
  check("margin", o.margin, o.margin > 0 && o.margin <= 1e9, "in (0, 1e9] [m]");
  check("max_depth", o.max_depth, o.max_depth >= 3 && o.max_depth <= 12, "in [3, 12]");
  check("band_depth", o.band_depth, o.band_depth >= 3 && o.band_depth <= o.max_depth, "in [3, max_depth]");
  check("most_samples", double(o.most_samples), o.most_samples >= 0, ">= 0");
  check("threads", o.threads, o.threads >= 1 && o.threads <= 256, "in [1, 256]");
}

}  // namespace

DistanceField DistanceField::build(const TriangleMesh& mesh, const DistanceFieldOptions& options,
                                   const Progress& progress) {
  check(options);
  check_body(mesh, "DistanceField");
  return build(ExactDistance(mesh), options, progress);
}

DistanceField DistanceField::build(const ExactDistance& exact, const DistanceFieldOptions& options,
                                   const Progress& progress) {
  check(options);
  DistanceField field;
  field.report_.tolerance = options.tolerance.value_or(std::min(1e-3 * exact.diagonal(), 2e-3));
  field.report_.sign = exact.report();
  field.size_ = (exact.high() - exact.low()).maxCoeff() + 2 * options.margin;
  field.low_ = (exact.low() + exact.high()) / 2 - Vec3::Constant(field.size_ / 2);
  field.max_depth_ = options.max_depth;
  field.outer_band_ = options.outer_band;
  field.inner_band_ = options.inner_band;
  field.far_slope_ = options.far_slope;
  field.gradient_ = options.gradient;
  const double unit = field.size_ / (1 << options.max_depth);
  LatticeSamples samples(exact, field.low_, unit, options.threads);
  const DistanceOctree octree(
      samples,
      {field.report_.tolerance, options.outer_band, options.inner_band, options.far_slope, 3,
       options.band_depth, options.max_depth, options.most_samples},
      unit, progress);
  field.report_.samples = samples.size();
  field.take(octree);
  field.index();
  if (progress) progress(1);
  return field;
}

void DistanceField::take(const DistanceOctree& octree) {
  std::vector<Vec3> gradients;
  if (gradient_ == GradientRule::interpolated_corners) gradients = octree.corner_gradients();
  report_.largest_repair = octree.largest_repair();
  const auto take_leaf = [&](const OctreeCell& cell) {
    leaves_.emplace_back();
    for (int c = 0; c < 8; ++c)
      leaves_.back()[2 * (c & 3) + c / 4] = static_cast<float>(octree.values()[cell.corner[c]]);
    report_.depth = std::max(report_.depth, cell.level);
    report_.leaves_at_max_depth += cell.level == max_depth_;
    if (gradients.empty()) return;
    leaf_gradients_.emplace_back();
    for (int c = 0; c < 8; ++c)
      for (int k = 0; k < 3; ++k)
        leaf_gradients_.back()[c][k] = static_cast<float>(gradients[cell.corner[c]][k]);
  };
  const auto take_node = [&](const auto& self, const OctreeCell& cell) -> Entry {
    const Entry node = static_cast<Entry>(nodes_.size());
    nodes_.emplace_back();
    for (int c = 0; c < 8; ++c) {
      const OctreeCell& child = octree.cells()[cell.first_child + c];
      if (child.first_child != 0) {
        const Entry entry = self(self, child);
        nodes_[node][c] = entry;
        continue;
      }
      nodes_[node][c] = leaf_bit | static_cast<Entry>(leaves_.size());
      take_leaf(child);
    }
    return node;
  };
  take_node(take_node, octree.cells()[0]);
  report_.leaves = static_cast<int>(leaves_.size());
  if (leaves_.size() > index_mask)
    throw std::invalid_argument("DistanceField: too many leaves; raise the tolerance");
}

}  // namespace furrow::physics
