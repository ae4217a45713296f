// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/made_for.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "bridge/arrays/convert.h"
#include "geometry/figure/place_garment.h"
#include "jobs/base/read_inputs.h"
#include "jobs/body/body_cache.h"

namespace furrow::jobs {
namespace {

constexpr double told_turn = 30;  // [degrees] from which on a limb's turn is told

geometry::Skeleton skeleton_of(const physics::TriangleMesh& body, const std::string& path) {
  std::vector<geometry::Point> points;
  for (const physics::Vec3& x : body.vertices) points.push_back(bridge::to_cgal(x));
  try {
    return geometry::find_skeleton(points, body.triangles);
  } catch (const geometry::ContentError& e) {
    throw geometry::ContentError(path + ": " + e.what() +
                                 ". `made_for` needs that of both bodies; without it the garment must lie "
                                 "about the body that it is draped on");
  }
}

double degrees(double radians) { return 180 / std::numbers::pi * radians; }

/// The wearer's left is on the side of x above the middle, unless the feet point to -z.
Placed report_of(const geometry::PlacedGarment& placed, const MadeFor& made_for) {
  Placed report;
  report.made_for = made_for.path;
  report.height_scale = placed.height_scale;
  report.mean_move = placed.mean_move;
  report.farthest_move = placed.farthest_move;
  const bool turned = made_for.to.faces < 0 || made_for.from.faces < 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t side = turned ? 1 - i : i;
    const std::string word = i ? "right " : "left ";
    report.limbs[i] = {word + "arm", {}, placed.arm_share[side]};
    if (placed.arm_turn[side]) report.limbs[i].turn = degrees(*placed.arm_turn[side]);
    report.limbs[2 + i] = {word + "leg", degrees(placed.leg_turn[side]), placed.leg_share[side]};
  }
  return report;
}

void warn_of_pose(const Placed& placed, const std::string& name, const Context& context) {
  std::string limbs;
  for (const Placed::Limb& limb : placed.limbs)
    if (limb.share > 0 && limb.turn && *limb.turn > told_turn)
      limbs += fmt::format("{}the {} by {:.0f} degrees", limbs.empty() ? "" : ", ", limb.name, *limb.turn);
  if (limbs.empty()) return;
  context.warn(
      "pose_differs",
      fmt::format("{}: the two bodies are posed differently, and so its cloth was turned, with {}; look at "
                  "armholes and crotch, where it begins pulled or pressed",
                  name, limbs),
      name, "made_for");
}

}  // namespace

void check_made_for(const std::filesystem::path& made_for, const io::Scene& scene) {
  if (!made_for.empty() && !scene.body)
    throw std::invalid_argument(
        "`made_for`: brings a garment from one body to another; name the other one with `body`");
}

MadeFor read_made_for(const std::filesystem::path& path, const physics::TriangleMesh& body,
                      const io::SceneBody& file, const Context& context) {
  MadeFor made_for{path.string(), {}, {}, {}};
  const physics::TriangleMesh from = kept_body(file.cache, path, context, &made_for.outline);
  const auto skeleton = [&](const physics::TriangleMesh& of, const std::filesystem::path& name) {
    return kept_skeleton(file.cache, of, context, [&] { return skeleton_of(of, name.string()); });
  };
  made_for.from = skeleton(from, path);
  made_for.to = skeleton(body, file.mesh);
  return made_for;
}

PlacedStart place(const geometry::Mesh& garment, const MadeFor& made_for, const BodyCollider& body,
                  const std::string& name, const Context& context) {
  heed(faults_of_pair(garment, made_for.outline, true), name, context);
  const geometry::PlacedGarment placed =
      naming(name, [&] { return geometry::place_garment(garment, made_for.from, made_for.to); });
  PlacedStart start{{}, report_of(placed, made_for)};
  for (const geometry::Point& p : placed.points) start.places.push_back(bridge::to_eigen(p));
  const physics::Penetration inside = physics::penetration(body.exact, start.places);
  start.report.inside = std::size_t(inside.inside);
  start.report.inside_share = double(inside.inside) / double(start.places.size());
  start.report.deepest = inside.deepest;
  warn_of_pose(start.report, name, context);
  return start;
}

geometry::Mesh at_places(geometry::Mesh mesh, std::span<const physics::Vec3> places) {
  if (!places.empty())
    for (const geometry::Vertex v : mesh.vertices()) mesh.point(v) = bridge::to_cgal(places[v.idx()]);
  return mesh;
}

Json to_json(const Placed& p) {
  Json turned = Json::object();
  for (const Placed::Limb& limb : p.limbs) {
    std::string key = limb.name;
    key[key.find(' ')] = '_';
    turned[key] = limb.turn ? Json(*limb.turn) : Json(nullptr);
  }
  return {{"made_for", p.made_for},
          {"height_scale", p.height_scale},
          {"turned", turned},
          {"mean_move", p.mean_move},
          {"farthest_move", p.farthest_move},
          {"inside", p.inside},
          {"inside_share", p.inside_share},
          {"deepest", p.deepest}};
}

}  // namespace furrow::jobs
