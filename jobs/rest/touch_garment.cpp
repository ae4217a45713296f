// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/touch_garment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "bridge/arrays/convert.h"
#include "bridge/draping/level_start.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/rest_angles.h"
#include "io/stroke/touch_file.h"
#include "jobs/base/read_inputs.h"
#include "jobs/cloth/prepare_garment.h"
#include "jobs/rest/garment_maker.h"
#include "physics/base/progress.h"
#include "physics/cloth/pins.h"

namespace furrow::jobs {
namespace {

constexpr int most_touch_iterations = 100;

std::vector<geometry::Touch> touches_of(const DrapeSettings& s, const Context& context) {
  std::vector<geometry::Touch> touches = s.touches;
  if (s.touch_file.empty()) return touches;
  const auto more = io::read_touches(s.touch_file, read_options(context.frame));
  touches.insert(touches.end(), more.begin(), more.end());
  return touches;
}

void require_at_rest(const DrapePlan& plan, const io::MeshFile& file) {
  const std::string name = plan.scene.garment.string();
  if (!geometry::find_map(file.mesh, geometry::attribute::rest_length))
    throw geometry::ContentError(name +
                                 ": `touches` go on cloth that rests, and this file has no rest state; take "
                                 "the PLY that `furrow drape` or `furrow wrinkle settle` wrote");
  if (!plan.places.empty())
    throw std::invalid_argument(
        "`touches` go on cloth where it rests, not on the way from the body of `made_for`; leave out one of "
        "them, and touch what that drape writes");
  if (plan.scene.subdivide > 0)
    throw std::invalid_argument(
        "`touches` change the rest state, which `subdivide` and `finest` replace; leave them out, and refine "
        "before the garment rests");
}

/// The cloth around a touch, which lay at `before` [m], goes where the touch has it, through no cloth and out
/// of the body, and comes to rest, all farther cloth held. Returns whether it balances.
bool settle_around(const geometry::Touch& touch, const std::vector<physics::Vec3>& before,
                   const DrapePlan& plan, io::MeshFile& file, const std::function<bool()>& go_on,
                   const Context& context) {
  geometry::Touch around = touch;
  around.radius *= touch.kind == geometry::TouchKind::pinch ? 2.5 : 1.5;
  const std::vector<double> near = geometry::touch_weights(file.mesh, around);
  GarmentMaker maker(plan.scene, plan.body, plan.settings, file, context);
  geometry::Mesh mesh = file.mesh;
  physics::Cloth cloth = maker(mesh);
  std::vector<int> far;
  for (std::size_t i = 0; i < near.size(); ++i)
    if (!(near[i] > 0)) far.push_back(int(i));
  physics::pin(cloth.particles, far);
  physics::drop_held_elements(cloth);
  bridge::DrapeOptions options = plan.options;
  if (plan.settings.self_contact != SelfContactUse::off) hold_apart(options, plan.settings);
  options.settle.max_iterations = most_touch_iterations;
  options.settle.self.max_iterations = most_touch_iterations;
  options.settle.faces = {};
  const physics::Collider* const body = plan.body ? &plan.body->field : nullptr;
  bridge::DrapeLevel start;
  const std::vector<physics::Vec3> wanted = cloth.particles.x;
  bridge::begin_level(cloth, {before, wanted}, {wanted, bridge::PlaceNoise({}, 0), 0}, body, options, start);
  const physics::SettleReport report =
      physics::settle(cloth, body, options.settle, [&](const physics::SettleProgress&) { return go_on(); });
  if (report.stopped) throw physics::Cancelled("touch: interrupted");
  for (const geometry::Vertex v : file.mesh->vertices())
    file.mesh->point(v) = bridge::to_cgal(cloth.particles.x[v.idx()]);
  return report.converged;
}

TouchReport touch_once(const geometry::Touch& touch, const DrapePlan& plan, io::MeshFile& file,
                       const std::function<bool()>& go_on, const Context& context) {
  const auto begun = std::chrono::steady_clock::now();
  TouchReport report{touch, 0, 0, false, 0, {}, bridge::positions_of(file.mesh), {}, {}};
  const std::vector<double> weights = geometry::touch_weights(file.mesh, touch);
  geometry::apply_touch(file.mesh, touch, weights);
  report.balances = settle_around(touch, report.before, plan, file, go_on, context);
  report.after = bridge::positions_of(file.mesh);
  const auto line = geometry::find_map(file.mesh, geometry::attribute::line);
  for (const geometry::Vertex v : file.mesh->vertices())
    if (line && weights[v.idx()] > 0 && (*line)[v] >= 0) report.lines.insert(std::size_t((*line)[v]));
  for (std::size_t i = 0; i < weights.size(); ++i) {
    report.held.push_back(weights[i] > 0);
    report.vertices += std::size_t(report.held[i]);
    if (report.held[i]) report.moved = std::max(report.moved, (report.after[i] - report.before[i]).norm());
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return report;
}

using Places = Eigen::Matrix3Xd;

Places places_of(const std::vector<physics::Vec3>& x, const std::vector<int>& which) {
  Places places(3, Eigen::Index(which.size()));
  for (std::size_t i = 0; i < which.size(); ++i) places.col(Eigen::Index(i)) = x[std::size_t(which[i])];
  return places;
}

/// The share of the change of shape from `before` to `after` that is in `now`, where and however it lies.
std::optional<double> kept_share(const Places& before, const Places& after, const Places& now) {
  constexpr double least = 5e-4;  // root mean square [m]; less is lost in what a rest moves by
  const auto change_to = [&before](const Places& places) -> Places {
    const Eigen::Matrix4d turn = Eigen::umeyama(places, before, false);
    return (turn.topLeftCorner<3, 3>() * places).colwise() + Eigen::Vector3d(turn.topRightCorner<3, 1>()) -
           before;
  };
  if (before.cols() < 4) return std::nullopt;
  const Places done = change_to(after);
  if (done.squaredNorm() < double(done.cols()) * least * least) return std::nullopt;
  return done.cwiseProduct(change_to(now)).sum() / done.squaredNorm();
}

}  // namespace

std::vector<TouchReport> touch_garment(GivenGarment& garment, const BodyCollider* body,
                                       const DrapeSettings& s, double gap, const Context& context) {
  const std::vector<geometry::Touch> touches = touches_of(s, context);
  if (touches.empty()) return {};
  io::MeshFile& file = garment.file;
  const DrapePlan plan{garment.scene,   body, s, file, drape_options_of(garment.scene, s, gap),
                       garment.places()};
  require_at_rest(plan, file);
  complete_garment(file, plan.scene.material);
  geometry::ensure_rest_angles(file.mesh);
  const ProgressScope progress(context.listener, "touching");
  std::vector<TouchReport> reports;
  for (const geometry::Touch& touch : touches) try {
      const auto go_on = [&] { return progress(double(reports.size()) / double(touches.size())); };
      reports.push_back(touch_once(touch, plan, file, go_on, context));
    } catch (const std::invalid_argument& e) {
      throw std::invalid_argument("touch " + std::to_string(reports.size() + 1) + ": " + e.what());
    }
  return reports;
}

void measure_remains(const geometry::Mesh& at_rest, std::vector<TouchReport>& touches) {
  const std::vector<physics::Vec3> now = bridge::positions_of(at_rest);
  std::vector<char> taken(now.size(), 0);
  for (auto t = touches.rbegin(); t != touches.rend(); ++t) {
    if (t->held.size() != now.size()) return;
    std::vector<int> own;
    for (std::size_t i = 0; i < now.size(); ++i)
      if (t->held[i] && !std::exchange(taken[i], 1)) own.push_back(int(i));
    t->remains = kept_share(places_of(t->before, own), places_of(t->after, own), places_of(now, own));
  }
}

Json to_json(const std::vector<TouchReport>& touches) {
  Json list = Json::array();
  for (const TouchReport& t : touches)
    list.push_back({{"kind", geometry::word_of(t.touch.kind)},
                    {"vertices", t.vertices},
                    {"moved", t.moved},
                    {"balances", t.balances},
                    {"seconds", t.seconds},
                    {"remains", t.remains ? Json(*t.remains) : Json()}});
  return list;
}

}  // namespace furrow::jobs
