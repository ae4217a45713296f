// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/place_garment.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/figure/limb_places.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr double blend_length = 0.05;  // m of cloth over which parts of the body blend

using Weights = std::array<double, body_parts>;

/// Each vertex goes wholly with the part that it lies nearest to.
std::vector<Weights> nearest_parts(const Mesh& garment, const Skeleton& body) {
  std::vector<Weights> weights(garment.num_vertices(), Weights{});
  for (const Vertex v : garment.vertices())
    weights[v.idx()][std::size_t(nearest_part(body, garment.point(v)))] = 1;
  return weights;
}

/// Diffuses along edges, over about the blend length: each round takes the mean of a vertex and its
/// neighbours', which spreads by half an edge's square.
void blend(const Mesh& garment, std::vector<Weights>& weights) {
  double squares = 0, count = 0;
  for (const Edge e : garment.edges()) {
    squares += (garment.point(garment.vertex(e, 0)) - garment.point(garment.vertex(e, 1))).squared_length();
    ++count;
  }
  if (!(squares > 0)) return;
  const double wanted = 2 * blend_length * blend_length / (squares / count);
  const int rounds = int(std::clamp(std::ceil(wanted), 2.0, 2000.0));
  std::vector<Weights> next = weights;
  for (int round = 0; round < rounds; ++round) {
    for (const Vertex v : garment.vertices()) {
      physics::throw_if_cancelled("place_garment");
      if (garment.is_isolated(v)) continue;
      Weights sum{};
      double n = 0;
      for (const Vertex w : garment.vertices_around_target(garment.halfedge(v))) {
        for (std::size_t k = 0; k < body_parts; ++k) sum[k] += weights[w.idx()][k];
        ++n;
      }
      for (std::size_t k = 0; k < body_parts; ++k) next[v.idx()][k] = (weights[v.idx()][k] + sum[k] / n) / 2;
    }
    weights.swap(next);
  }
}

double angle_between(const Vector& a, const Vector& b) {
  return std::atan2(std::sqrt(CGAL::cross_product(a, b).squared_length()), a * b);
}

void check_sides(const Skeleton& from, const Skeleton& to, const std::vector<Weights>& weights) {
  if (from.faces * to.faces < 0)
    throw ContentError(
        "the two bodies face opposite ways, by their feet; turn one of them by half a turn about its upright "
        "axis");
  for (std::size_t side = 0; side < 2; ++side) {
    if (to.arms[side]) continue;
    const bool sleeve = std::any_of(weights.begin(), weights.end(), [&](const Weights& w) {
      return w[std::size_t(arm_part(int(side)))] > 0.5;
    });
    if (sleeve)
      throw ContentError(std::string("the garment has a sleeve on the side of ") + (side ? "-x" : "+x") +
                         ", where no arm of the body was found; its arm must stand off from the trunk");
  }
}

void measure_moves(const Mesh& garment, PlacedGarment& placed) {
  double sum = 0, count = 0;
  for (const Vertex v : garment.vertices()) {
    const double moved = std::sqrt((placed.points[v.idx()] - garment.point(v)).squared_length());
    sum += moved, ++count;
    placed.farthest_move = std::max(placed.farthest_move, moved);
  }
  placed.mean_move = sum / count;
}

}  // namespace

PlacedGarment place_garment(const Mesh& garment, const Skeleton& from, const Skeleton& to) {
  if (garment.number_of_vertices() == 0) refuse("place_garment", "the garment has no vertices");
  require_finite(garment, "place_garment");
  std::vector<Weights> weights = nearest_parts(garment, from);
  check_sides(from, to, weights);
  PlacedGarment placed;
  for (const Vertex v : garment.vertices())
    for (int side = 0; side < 2; ++side) {
      const double share = 1.0 / double(garment.number_of_vertices());
      placed.arm_share[std::size_t(side)] += share * weights[v.idx()][std::size_t(arm_part(side))];
      placed.leg_share[std::size_t(side)] += share * weights[v.idx()][std::size_t(leg_part(side))];
    }
  blend(garment, weights);
  placed.points.assign(garment.num_vertices(), Point(0, 0, 0));
  const PartMaps maps(from, to);
  for (const Vertex v : garment.vertices()) {
    Vector sum(0, 0, 0);
    for (int part = 0; part < body_parts; ++part)
      if (const double w = weights[v.idx()][std::size_t(part)]; w > 0)
        sum += w * (maps.moved(part, garment.point(v)) - CGAL::ORIGIN);
    placed.points[v.idx()] = CGAL::ORIGIN + sum;
  }
  placed.height_scale = (to.high - to.low) / (from.high - from.low);
  for (std::size_t side = 0; side < 2; ++side) {
    if (from.arms[side] && to.arms[side])
      placed.arm_turn[side] = angle_between(from.arms[side]->axis, to.arms[side]->axis);
    placed.leg_turn[side] = angle_between(from.legs[side].axis, to.legs[side].axis);
  }
  measure_moves(garment, placed);
  return placed;
}

}  // namespace furrow::geometry
