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

physics::DistanceFieldOptions to_options(const BodyArguments& a) {
  physics::DistanceFieldOptions o;
  o.tolerance = a.tolerance;
  o.gradient = a.gradient == "exact" ? physics::GradientRule::exact_derivative
                                     : physics::GradientRule::interpolated_corners;
  o.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return o;
}

}  // namespace

void add_field_options(CLI::App& sub, BodyArguments& a) {
  sub.add_option("--tolerance", a.tolerance,
                 "error of the body's distance field [m]; default 1/1000 of its diagonal, at most 0.002");
  sub.add_option("--gradient", a.gradient,
                 "of the field: exact (of the interpolated distance) or interpolated (of the corners', as in "
                 "the paper)")
      ->check(CLI::IsMember({"exact", "interpolated"}))
      ->capture_default_str();
}

void add_body_options(CLI::App& sub, BodyArguments& a) {
  sub.add_option("--body", a.path, "rigid body that the garment rests on");
  sub.add_option("--field", a.field, "the body's distance field, saved by furrow sdf");
  add_field_options(sub, a);
}

BodyCollider load_body(const BodyArguments& a, const CommonArguments& common) {
  if (!a.field.empty() && (a.tolerance || a.gradient != "exact"))
    throw UsageError(
        "--tolerance and --gradient are those of the saved --field; make another with furrow sdf");
  const geometry::Body repaired = geometry::repair_body(read_mesh(a.path, common).mesh);
  tell_repairs(a.path, repaired.report, common);
  physics::TriangleMesh triangles = bridge::to_triangle_mesh(repaired);
  physics::ExactDistance exact(triangles);
  physics::DistanceField field = a.field.empty() ? physics::DistanceField::build(exact, to_options(a))
                                                 : io::read_field(a.field, triangles);
  return {std::move(triangles), std::move(exact), std::move(field)};
}

double contact_gap(double wanted, const BodyCollider& body, const geometry::Mesh& garment) {
  constexpr double kLimbRadius = 0.05;
  std::vector<double> lengths;
  const auto rest = *geometry::find_map(garment, geometry::kRestLength);
  for (geometry::Edge e : garment.edges()) lengths.push_back(rest[e]);
  const auto long_edge = lengths.begin() + static_cast<std::ptrdiff_t>(0.95 * double(lengths.size() - 1));
  std::nth_element(lengths.begin(), long_edge, lengths.end());
  const double sag = *long_edge * *long_edge / (8 * kLimbRadius);
  return std::max(wanted, sag + 1.5 * body.field.report().tolerance);
}

}  // namespace furrow::cli
