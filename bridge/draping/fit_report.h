// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh/mesh_fwd.h"
#include "physics/base/arrays.h"
#include "physics/body/exact_distance.h"

namespace furrow::bridge {

/// Vertex attributes (geometry/mesh/vertex_attributes.h) that fit_report() writes: plain columns of a PLY.
inline constexpr const char* fit_distance = "fit_distance";  ///< to the body [m], in every unit of the file
inline constexpr const char* fit_strain = "strain";          ///< [-]

/// Heights of the sections where ease is measured, y [m]; finite where told.
struct SectionHeights {
  std::optional<double> chest, waist, hip;
};

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

/// A connected part of a garment where a value is over a threshold.
struct FitZone {
  double area = 0;                                ///< as worn [m^2]
  double peak = 0;                                ///< the largest value at a vertex of it
  geometry::Coordinates<geometry::Point> centre;  ///< its centre of area [m]
  double height_share = 0;                        ///< of the centre, over the body's height: 0 soles, 1 crown
  std::string side;  ///< where the centre lies: front, back, left or right of the wearer, or
                     ///< around, where it is within 5 cm of the torso's middle
};

/// Where a body comes through a garment.
struct FitPiercing {
  std::size_t faces = 0;       ///< that cross or touch the body's surface (geometry/stroke/pierced_faces.h)
  double deepest = 0;          ///< of all points of the garment inside the body, as sampled [m], >= 0
  std::vector<FitZone> zones;  ///< of pierced faces and those with all corners inside; peak: their depth [m]
  std::vector<std::size_t> corners;  ///< vertices of the faces of all zones by index, in ascending order
};

/// Room between garment and body at one height. What cannot be measured is missing, and `note` says why.
struct FitEase {
  std::string name;                      ///< chest, waist or hip
  double height = 0;                     ///< y, where the body is measured [m]
  std::optional<double> garment_height;  ///< y, where the garment is measured [m]: below its armholes where
                                         ///< the section at `height` runs through its sleeves
  std::optional<double> body_girth;      ///< by the tape measure (geometry/figure/horizontal_section.h) [m]
  std::optional<double> garment_girth;   ///< the garment's curve around the body, all its folds followed [m]
  std::optional<double> ease;            ///< garment_girth - body_girth [m]
  std::optional<double> rest_girth;      ///< the same curve with the cloth unstrained [m]; none without rest
  std::optional<double>
      rest_ease;  ///< rest_girth - body_girth [m]: < 0, the garment is smaller than the body
  /// "", why something is missing, or that the garment is measured below its armholes.
  std::string note;
};

struct FitReport {
  double area = 0;                     ///< of the garment as it is worn [m^2]
  bool on_body = true;                 ///< false: strain_report() made it; distance, loose, ease say nothing
  double body_low = 0, body_high = 0;  ///< lowest and highest y of the body, else of the garment [m]
  std::optional<FitStrain> strain;     ///< none: the garment has no rest lengths
  FitDistance distance;
  FitPiercing piercing;               ///< zones largest first
  std::vector<FitZone> tight, loose;  ///< largest first; tight: empty without strain
  std::size_t left_out = 0;           ///< zones of either kind that were too small
  std::vector<FitEase> ease;          ///< chest, waist, hip, as far as their heights are known
};

/// How a worn garment fits a body: distances, strain, tight and loose zones, ease. `body` and `distance` are
/// one body (bridge/arrays/gather.h), y up, in the pose in which the garment was worn. Writes the attributes
/// fit_distance and, where any e:rest_length is set, fit_strain; changes nothing else. Cost: a distance query
/// a vertex (1 us), what measure_piercing() costs, and about 100 plane sections of the body. Throws
/// std::invalid_argument for an option out of its range, geometry::ContentError for a mesh without area, a
/// position that is not finite, a face that is no triangle or a broken rest length; physics::Cancelled
/// (physics/base/cancel_scope.h); the mesh untouched.
///
/// \details fit_strain is at a vertex the mean of its faces by area, and 0 at a vertex of no face. Zones join
/// faces through edges, by the mean of their corners.
FitReport fit_report(geometry::Mesh& garment, const physics::TriangleMesh& body,
                     const physics::ExactDistance& distance, const FitOptions& options = {});

/// What a garment tells without a body: area, strain, tight zones, placed by the garment's own box. Writes
/// the attribute fit_strain where any e:rest_length is set; changes nothing else. Throws as fit_report().
FitReport strain_report(geometry::Mesh& garment, const FitOptions& options = {});

}  // namespace furrow::bridge
