// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/body.h"

#include <algorithm>
#include <thread>

#include "bridge/body.h"
#include "geometry/property_names.h"
#include "io/field_file.h"

namespace furrow::cli {
namespace {

void tell_repairs(const std::string& path, const geometry::BodyReport& r, const CommonArguments& common) {
  const auto tell = [&](std::size_t n, const char* what) {
    if (n) warn(path + ": " + std::to_string(n) + " " + what, common);
  };
  tell(r.filled_holes, "holes of the body filled");
  tell(r.dropped_faces, "faces of the body dropped");
  tell(r.reversed_faces, "faces of the body turned outwards");
}

}  // namespace

BodyCollider load_body(const io::SceneBody& body, const CommonArguments& common) {
  const geometry::Body repaired = geometry::repair_body(read_mesh(body.mesh.string(), common).mesh);
  tell_repairs(body.mesh.string(), repaired.report, common);
  physics::TriangleMesh triangles = bridge::to_triangle_mesh(repaired);
  physics::ExactDistance exact(triangles);
  physics::DistanceFieldOptions options = body.options;
  options.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  physics::DistanceField field = body.field.empty() ? physics::DistanceField::build(exact, options)
                                                    : io::read_field(body.field, triangles);
  return {std::move(triangles), std::move(exact), std::move(field)};
}

double contact_gap(double wanted, double field_tolerance, const geometry::Mesh& garment) {
  constexpr double kLimbRadius = 0.05;
  std::vector<double> lengths;
  const auto rest = *geometry::find_map(garment, geometry::kRestLength);
  for (geometry::Edge e : garment.edges()) lengths.push_back(rest[e]);
  const auto long_edge = lengths.begin() + static_cast<std::ptrdiff_t>(0.95 * double(lengths.size() - 1));
  std::nth_element(lengths.begin(), long_edge, lengths.end());
  const double sag = *long_edge * *long_edge / (8 * kLimbRadius);
  return std::max(wanted, sag + 1.5 * field_tolerance);
}

}  // namespace furrow::cli
