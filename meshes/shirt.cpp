// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "meshes/garments.h"
#include "meshes/mannequin.h"
#include "meshes/surfaces.h"

namespace furrow::meshes {
namespace {

constexpr double shirt_hem = 0.90, sleeve_length = 0.19;  // height; length along the arm [m]

/// As wide as the bust and the seat everywhere below them: cloth hangs from there.
const Loft trunk_shape({0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1},
                       {{0.84, 0.196, 0.162, -0.010},
                        {0.92, 0.190, 0.158, -0.008},
                        {1.00, 0.181, 0.150, -0.002},
                        {1.10, 0.172, 0.142, 0.002},
                        {1.18, 0.168, 0.138, 0.003},
                        {1.25, 0.166, 0.134, 0.002},
                        {1.31, 0.165, 0.118, -0.008},
                        {1.36, 0.156, 0.090, -0.022},
                        {1.40, 0.124, 0.066, -0.030}});
const Loft sleeve_sides({0.160, 1.354, -0.024}, {0.6, -0.8, 0}, {0.8, 0.6, 0}, {0, 0, 1},
                        {{-0.02, 0.045, 0.048},
                         {0.03, 0.058, 0.062},
                         {0.08, 0.064, 0.067},
                         {0.16, 0.067, 0.069},
                         {0.26, 0.070, 0.071}});

/// Cloth spans the hollows below the bust, along the spine and under the arms.
double inside_of_shirt(const Vec& p) {
  const double skin = trunk(p) - 0.009;
  const double sleeves = with_mirror_image(p, 0.01, sleeve_sides);
  return smooth_union(smooth_union(skin, trunk_shape(p), 0.03), sleeves, 0.05);
}

double from_hole(const Vec& p) {  // > 0: cloth
  const Vec q(std::abs(p.x()), p.y(), p.z());
  const double hem = q.y() - shirt_hem;
  const bool on_arm = left_arm().from_axis(q) < 0.12;
  const double sleeve = on_arm ? sleeve_length - left_arm().along(q) : 1;
  const double x = q.x() / 0.088, z = (q.z() + 0.010) / 0.084;
  const double neck = q.y() > 1.3 ? (std::sqrt(x * x + z * z) - 1) * 0.085 : 1;
  return std::min({hem, sleeve, neck});
}

}  // namespace

geometry::Mesh make_shirt() {
  geometry::Mesh mesh =
      cut(mesh_surface(inside_of_shirt, {-0.45, 0.80, -0.25}, {0.45, 1.60, 0.25}, 0.010), from_hole);
  remesh(mesh, 0.014);
  return mesh;
}

}  // namespace furrow::meshes
