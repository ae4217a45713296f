// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/SparseCholesky>
#include <array>
#include <span>
#include <vector>

#include "geometry/mesh/mesh_fwd.h"
#include "physics/body/exact_distance.h"

namespace furrow::bridge {

struct FollowOptions {
  double reach = 0.01;  ///< off the skin at which a vertex follows as wide a patch of it [m]; > 0
  double gap = 0.003;   ///< that is kept, where the garment kept it from the body as it was [m]; >= 0
};

/// How a garment that fits a body goes along as the body changes its shape, its vertices and triangles the
/// same.
///
/// \details Each vertex v wants to move as the skin nearest to it, d_v, and as its neighbours do: the moves u
/// minimise  sum_v A_v c_v |u_v - d_v|^2 + r^2 sum_edges |u_i - u_j|^2  with c_v = (r / (distance_v + 2
/// mm))^2, the reach r and the area A_v of a vertex, so that cloth near the skin follows it closely, and what
/// hangs free follows a wide patch. u is linear in the body's moves: mixtures of shapes are mixtures of u.
/// What of the cloth (vertices, middles of edges and faces) then lies nearer to the new body than the gap,
/// and nearer than it lay to the old one, is pushed out, and its surroundings with it.
class BodyFollower {
 public:
  /// The body's triangles as they lie when the garment fits [m]; any soup that ExactDistance takes. Throws
  /// std::invalid_argument for options out of range, or a garment without faces or
  /// with a place that is not finite. O(n) but for the factor,
  /// O(n^1.5).
  BodyFollower(const geometry::Mesh& garment, const physics::TriangleMesh& body,
               const FollowOptions& options = {});

  /// Of the garment's vertices [m], where those of the body move so, not yet pushed out.
  std::vector<physics::Vec3> follow(std::span<const physics::Vec3> body_moves) const;
  /// Pushes the garment, moved so, out of the body, moved so. Cost: some rounds of distances.
  void push_out(std::vector<physics::Vec3>& moves, std::span<const physics::Vec3> body_moves) const;
  /// How much deeper in the body, moved so, the garment lies than it lay at first, where it does so most [m];
  /// 0: nowhere.
  double deepest(std::span<const physics::Vec3> moves, std::span<const physics::Vec3> body_moves) const;

 private:
  /// A point of the cloth.
  struct Sample {
    std::array<int, 3> vertices;
    physics::Vec3 weights;
    int triangle = 0;      ///< of the body, the nearest at first
    double clearance = 0;  ///< at first [m]
  };
  physics::Vec3 place_of(const Sample& sample, std::span<const physics::Vec3> moves) const;
  physics::ExactDistance moved_body(std::span<const physics::Vec3> body_moves) const;
  void add_samples(const geometry::Mesh& garment);
  void factor(const geometry::Mesh& garment);
  void find_outward();
  void spread(std::vector<physics::Vec3>& pushes, const std::vector<char>& pushed) const;

  FollowOptions options_;
  std::vector<physics::Vec3> places_;
  physics::TriangleMesh body_;
  physics::ExactDistance distance_;
  std::vector<Sample> samples_;         ///< those of vertices first, by index
  std::vector<physics::Vec3> nearest_;  ///< of vertices: weights of the corners of the nearest triangle
  std::vector<double> pull_;            ///< A_v c_v [m^2]
  std::vector<std::vector<int>> neighbours_;
  std::vector<physics::Vec3> outward_;  ///< unit vectors, by vertex
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace furrow::bridge
