// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "bridge/fit_ease.h"
#include "bridge/fit_piercing.h"
#include "bridge/fit_zones.h"
#include "geometry/mesh/mesh.h"
#include "physics/base/triangle_mesh.h"
#include "physics/body/exact_distance.h"

namespace furrow::bridge {

/// Vertex attributes (geometry/mesh/vertex_attributes.h) that fit_report() writes: plain columns of a PLY.
inline constexpr const char* fit_distance = "fit_distance";  ///< to the body [m], in every unit of the file
inline constexpr const char* fit_strain = "strain";          ///< [-]

struct FitOptions {
  double tight_strain = 0.05;      ///< cloth strained more is tight [-], > 0
  double loose_distance = 0.05;    ///< cloth farther from the body is loose [m], > 0
  double contact_distance = 0.01;  ///< cloth nearer lies on the body [m], >= 0; simulations keep a gap
  double smallest_zone = 0.001;    ///< zones with less area are left out [m^2], >= 0
  SectionHeights sections;         ///< where told, in place of what is found on the body
};

/// Engineering strain of the faces along the direction in which each is stretched most
/// (geometry/figure/principal_strain.h), weighted by area: > 0 stretched, < 0 pressed together in all
/// directions.
struct FitStrain {
  double share_over = 0;             ///< of the area, strained more than tight_strain, in [0, 1]
  double p50 = 0, p99 = 0, max = 0;  ///< [-]
  std::size_t unknown_faces = 0;     ///< whose rest lengths span no triangle; they do not count
};

/// Exact signed distances of the vertices, negative inside the body; each stands for a third of the area of
/// its faces.
struct FitDistance {
  double min = 0, median = 0, p95 = 0;  ///< [m]
  double share_in_contact = 0;          ///< of the area, in [0, 1]
  std::size_t vertices_inside = 0;
  double deepest_penetration = 0;  ///< of vertices and pierced faces [m], >= 0
};

struct FitReport {
  double area = 0;                     ///< of the garment as it is worn [m^2]
  double body_low = 0, body_high = 0;  ///< lowest and highest y of the body [m]
  std::optional<FitStrain> strain;     ///< none: the garment has no rest lengths
  FitDistance distance;
  FitPiercing piercing;               ///< zones largest first
  std::vector<FitZone> tight, loose;  ///< largest first; tight: empty without strain
  std::size_t left_out = 0;           ///< zones of either kind that were too small
  std::vector<FitEase> ease;          ///< chest, waist, hip, as far as their heights are known
};

/// How a worn garment fits a body: distances, strain, tight and loose zones, ease. `body` and `distance` are
/// one body (bridge/body.h), y up, in the pose in which the garment was worn. Writes the attributes
/// fit_distance and, where any e:rest_length is set, fit_strain; changes nothing else. Cost: a distance query
/// a vertex (1 us), what measure_piercing() costs, and about 100 plane sections of the body. Throws
/// std::invalid_argument for an option out of its range, geometry::ContentError for a mesh without area, a
/// position that is not finite, a face that is no triangle or a broken rest length, the mesh untouched.
///
/// \details fit_strain is at a vertex the mean of its faces by area, and 0 at a vertex of no face. Zones join
/// faces through edges, by the mean of their corners.
FitReport fit_report(geometry::Mesh& garment, const physics::TriangleMesh& body,
                     const physics::ExactDistance& distance, const FitOptions& options = {});

}  // namespace furrow::bridge
