// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <span>

#include "geometry/mesh/mesh_fwd.h"

namespace furrow::geometry {

/// uniform: every neighbour counts the same. cotangent: of the rest lengths (attribute::rest_length; where
/// unset, the lengths at the start), frozen: a plane mesh at rest keeps all its vertices.
enum class SmoothingWeights { uniform, cotangent };
/// keep: vertices of lines (attribute::line >= 0) average vertices of lines only, so that the ridge survives
/// (method S1.6).
enum class LineRule { free, keep };
/// free: border vertices average all their neighbours, so that a hem can lengthen.
/// keep: they average their neighbours along the border only.
enum class BorderRule { free, keep };

struct TaubinOptions {
  int iterations = 10;   ///< pairs of steps, a shrinking one and an inflating one; [0, 100000]
  double lambda = 0.33;  ///< factor of the shrinking step [-]; > 0
  double mu = -0.34;     ///< factor of the inflating step [-]; < -lambda, and stable (see taubin_smooth)
  SmoothingWeights weights = SmoothingWeights::uniform;
  LineRule lines = LineRule::free;
  BorderRule border = BorderRule::free;
};

struct SmoothReport {
  std::size_t smoothed_vertices = 0;  ///< vertices that the filter moves
  std::size_t kept_vertices = 0;      ///< vertices of the region that stay: isolated, ends and corners kept
  double k_max = 0;                   ///< bound of the spectrum: 2 uniform, 3 cotangent
  double k_stab = 0;                  ///< largest k for which lambda, mu are stable
  double pass_band_gain = 1;          ///< how much the slowest waves may grow: f(k_PB / 2)^iterations
};

/// Largest eigenvalue k up to which |f(k)| <= 1 beyond the pass band, f(k) = (1 - lambda k)(1 - mu k):
/// k_stab = ((lambda + mu) - sqrt((lambda + mu)^2 - 8 lambda mu)) / (2 lambda mu).
double stability_limit(double lambda, double mu);

/// Smooths without shrinking (method S1.5, S1.6): iterations times x -= lambda K x, then x -= mu K x, with K
/// = I - W, each step from the old positions only (Jacobi). `region` lists the vertices that may move, in any
/// order; an empty one means the whole mesh. All other vertices keep their bits; connectivity and every map
/// stay. Same input, same bits. Throws std::invalid_argument, the mesh untouched, for an option out of its
/// range or an unstable pair; ContentError if a position is not finite or, with cotangents, a face is no
/// triangle. Cost: O(iterations x edges of the region), two copies of its positions, and O(mesh) once.
/// \details On a closed mesh a wave of eigenvalue k is multiplied by f(k) for each pair. Refused are k_max >
/// k_stab (the shortest waves would grow) and k_PB = 1/lambda + 1/mu >= k_max (all would); k_max = 2 for
/// uniform weights, 3 for cotangents (reached by needles only, but 2.45 has been seen on real meshes). With
/// lines kept, a line vertex with fewer than two line neighbours (ends, lone ones) keeps its place, and with
/// the border kept as well, line vertices on the border do. Kept lines and borders weigh by 1/length where
/// the weights are cotangents. Source: G. Taubin, "A signal processing approach to fair surface design",
/// SIGGRAPH 1995.
SmoothReport taubin_smooth(Mesh& mesh, std::span<const Vertex> region, const TaubinOptions& options = {});

}  // namespace furrow::geometry
