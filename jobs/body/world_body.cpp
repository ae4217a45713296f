// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/body/world_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <thread>

#include "bridge/arrays/convert.h"
#include "bridge/arrays/gather.h"
#include "bridge/draping/fit_piercing.h"
#include "geometry/figure/repair_body.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "geometry/rest/rest_metric.h"
#include "io/base/bytes_file.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/state_file.h"
#include "jobs/base/gate.h"
#include "jobs/base/read_inputs.h"
#include "jobs/body/body_cache.h"
#include "physics/body/compare_colliders.h"
#include "physics/body/depth_map_collider.h"
#include "physics/body/posed_collider.h"
#include "physics/contact/contact.h"
#include "physics/motion/simulate.h"

namespace furrow::jobs {
namespace {

void tell_repairs(const std::string& path, const geometry::BodyReport& r, const Context& context) {
  const auto tell = [&](const char* code, std::size_t n, const std::string& thing, const char* done) {
    if (n)
      context.warn(code, path + ": " + std::to_string(n) + " " + thing + (n > 1 ? "s" : "") + done, path);
  };
  tell("body_holes_filled", r.filled_holes, "hole", " of the body filled");
  tell("body_faces_dropped", r.dropped_faces, "face", " of the body dropped");
  tell("body_faces_turned", r.reversed_faces, "face", " of the body turned outwards");
}

/// More than a millionth of its box' diagonal to the third.
bool has_volume(const physics::TriangleMesh& body) {
  double volume = 0;
  const physics::Vec3 origin = body.vertices.empty() ? physics::Vec3(0, 0, 0) : body.vertices[0];
  const auto from_origin = [&](int i) -> physics::Vec3 { return body.vertices[std::size_t(i)] - origin; };
  for (const auto& t : body.triangles)
    volume += from_origin(t[0]).dot(from_origin(t[1]).cross(from_origin(t[2]))) / 6;
  return std::abs(volume) > 1e-6 * std::pow(box_of(body.vertices).diagonal().norm(), 3);
}

/// The field, of no more samples than the gate lets pass unasked.
physics::DistanceField field_of(const physics::ExactDistance& exact, physics::DistanceFieldOptions options,
                                const std::string& name, const Context& context) {
  const ProgressScope progress(context.listener, "distance field");
  if (options.most_samples == 0) options.most_samples = limits.field_samples;
  try {
    return physics::DistanceField::build(exact, options, std::cref(progress));
  } catch (const physics::TooMuchWork& e) {
    require_allowed(name + ": " + e.what(), context);
  }
  options.most_samples = 0;
  return physics::DistanceField::build(exact, options, std::cref(progress));
}

physics::DistanceFieldOptions threaded(physics::DistanceFieldOptions options) {
  options.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return options;
}

physics::DepthMapOptions six_maps() {
  physics::DepthMapOptions options;
  options.maps = physics::DepthMaps::six;
  options.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return options;
}

/// Throws geometry::ContentError, naming file and frame, for one that is collapsed.
void require_area(const std::vector<physics::Vec3>& x, const std::vector<std::array<int, 3>>& triangles,
                  const std::string& path, int frame) {
  const auto has_area = [&](const std::array<int, 3>& t) {
    const physics::Vec3 ab = x[std::size_t(t[1])] - x[std::size_t(t[0])],
                        ac = x[std::size_t(t[2])] - x[std::size_t(t[0])];
    return ab.cross(ac).squaredNorm() > 0;
  };
  if (std::none_of(triangles.begin(), triangles.end(), has_area))
    throw geometry::ContentError(path + ": frame " + std::to_string(frame) +
                                 ": none of the body's faces has an area; a body is a closed surface");
}

/// 1/1000 of the body's diagonal, 2 mm at most.
double usual_tolerance(const physics::ExactDistance& body) { return std::min(1e-3 * body.diagonal(), 0.002); }

physics::DistanceFieldOptions with_finer_field(physics::DistanceFieldOptions options, double at_most,
                                               const physics::ExactDistance& body) {
  const double usual = usual_tolerance(body);
  if (!options.tolerance && at_most < usual) options.tolerance = std::max(at_most, usual / 4);
  return options;
}

std::string fingerprint_of(const std::vector<physics::Vec3>& vertices, double tolerance) {
  std::string bytes(reinterpret_cast<const char*>(vertices.data()), vertices.size() * sizeof(physics::Vec3));
  bytes.append(reinterpret_cast<const char*>(&tolerance), sizeof tolerance);
  return io::content_hash(std::as_bytes(std::span(bytes)));
}

}  // namespace

Frame with_unit(Frame frame, const std::optional<std::string>& unit) {
  if (unit) frame.unit = unit;
  return frame;
}

physics::TriangleMesh read_body(const MeshInput& input, const Context& context, BodyOutline* outline) {
  const std::string path = name_of(input, "body");
  const io::MeshFile file = read_garment(input, context, "body");
  heed(faults_of_body(file.mesh, context.frame.up.has_value()), path, context);
  if (outline) *outline = outline_of(file.mesh);
  stop_if_cancelled(context);
  const geometry::Body repaired = geometry::repair_body(file.mesh);
  stop_if_cancelled(context);
  tell_repairs(path, repaired.report, context);
  physics::TriangleMesh triangles = bridge::to_triangle_mesh(repaired);
  if (!has_volume(triangles))
    throw geometry::ContentError(path +
                                 ": encloses no volume, so nothing can be inside or outside of it; a "
                                 "body is a closed surface");
  stop_if_cancelled(context);
  return triangles;
}

double tolerance_for(double gap) {
  return gap < physics::SimulateOptions{}.contact_gap ? gap / 2 : std::numeric_limits<double>::infinity();
}

double tolerance_for(const io::MeshFile& worn) {
  const auto record = io::find_wrinkle_record(worn);
  const bool small = record && record->contact_gap > 0 && std::isfinite(tolerance_for(record->contact_gap)) &&
                     geometry::find_map(worn.mesh, geometry::attribute::rest_length);
  return small ? record->contact_gap - edge_sag(worn.mesh) : std::numeric_limits<double>::infinity();
}

double tolerance_for(const io::SavedState& state) {
  return state.field_tolerance > 0 ? state.field_tolerance : tolerance_for(state.file);
}

namespace {

/// All that a load of a file depends on; "": a file that is not there, or a mesh in memory.
std::string shelf_key(const io::SceneBody& body, const Context& context, double at_most) {
  std::error_code fault;
  const auto size = std::filesystem::file_size(body.mesh, fault);
  const auto written = std::filesystem::last_write_time(body.mesh, fault);
  if (fault || context.memory->find_mesh(body.mesh)) return "";
  const Frame frame = with_unit(context.frame, body.unit);
  const physics::DistanceFieldOptions& o = body.options;
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", body.mesh.string(), size,
                     written.time_since_epoch().count(), frame.unit_in_use(), frame.up_in_use(), at_most,
                     o.tolerance.value_or(0), o.outer_band, o.inner_band, o.far_slope, o.margin, o.band_depth,
                     o.max_depth, int(o.gradient), o.most_samples);
}

BodyCollider load_anew(const io::SceneBody& body, const Context& context, double at_most) {
  BodyOutline outline;
  const Context own{with_unit(context.frame, body.unit), context.listener, context.memory};
  const bool in_memory = context.memory && context.memory->find_mesh(body.mesh);
  const std::filesystem::path cache = in_memory ? "" : body.cache;
  physics::TriangleMesh triangles = kept_body(cache, body.mesh, own, &outline);
  physics::ExactDistance exact(triangles);
  const physics::DistanceFieldOptions options = with_finer_field(threaded(body.options), at_most, exact);
  physics::DistanceField field = kept_field(cache, triangles, options, context, [&] {
    return field_of(exact, options, body.mesh.string(), context);
  });
  return {std::move(triangles), std::move(exact), std::move(field), outline};
}

}  // namespace

BodyCollider load_body(const io::SceneBody& body, const Context& context, double at_most) {
  stop_if_cancelled(context);
  BodyShelf* const shelf = context.memory ? context.memory->shelf.get() : nullptr;
  const std::string key = shelf ? shelf_key(body, context, at_most) : "";
  if (!key.empty() && shelf->key == key) return *shelf->body;
  BodyCollider loaded = load_anew(body, context, at_most);
  if (!key.empty()) *shelf = {key, std::make_shared<const BodyCollider>(loaded)};
  return loaded;
}

WorldBody::WorldBody(const io::SceneBody& body, const Context& context, double at_most)
    : path_(body.mesh.string()), unit_(body.unit), motion_(body.motion) {
  if (!body.frames.empty()) {
    read_frames(body, {with_unit(context.frame, body.unit), context.listener, context.memory});
  } else {
    rigid_ = std::make_unique<BodyCollider>(load_body(body, context, at_most));
    tolerance_ = rigid_->field.report().tolerance;
    fingerprint_ = fingerprint_of(rigid_->triangles.vertices, tolerance_);
  }
}

void WorldBody::read_frames(const io::SceneBody& body, const Context& context) {
  const geometry::Mesh mesh = read_garment(body.mesh, context, "body").mesh;
  heed(faults_of_body(mesh, context.frame.up.has_value()), body.mesh.string(), context);
  for (geometry::Halfedge h : mesh.halfedges())
    if (mesh.is_border(h))
      throw geometry::ContentError(body.mesh.string() +
                                   ": a body with frames must be closed, this one has holes; close them");
  io::FrameSourceOptions options;
  if (body.fps > 0) options.fps = body.fps;
  options.frame = read_options(context.frame);
  frames_ = io::open_frames(body.frames, mesh.number_of_vertices(), options);
  if (frames_->frames() < 2)
    throw geometry::ContentError(body.frames.string() + ": has one frame; motion takes two or more");
  triangles_ = bridge::triangles_of(mesh);
  const auto read = [this, path = body.frames.string()](int i) {
    std::vector<physics::Vec3> x = frames_->positions(static_cast<std::size_t>(i));
    require_area(x, triangles_, path, i);
    return x;
  };
  tolerance_ = body.depth_maps ? 0.002 : 0;  // of depth maps 95 times of 100
  animated_ =
      std::make_unique<physics::AnimatedBody>(physics::BodyFrames{triangles_, frames_->times(), read},
                                              body.depth_maps ? std::optional(six_maps()) : std::nullopt);
  if (body.depth_maps) check_maps(context);
  fingerprint_ = fingerprint_of(frames_->positions(0), tolerance_) +
                 fingerprint_of(frames_->positions(frames_->frames() - 1), frames_->times().back());
  if (body.depth_maps) fingerprint_ += "maps";
}

/// Warns where depth maps of the first, a middle or the last frame do not see enough of the body.
void WorldBody::check_maps(const Context& context) const {
  const std::size_t last = frames_->frames() - 1;
  for (const std::size_t i : {std::size_t(0), last / 2, last}) {
    const physics::TriangleMesh mesh{frames_->positions(i), triangles_};
    const auto test = physics::compare_colliders(physics::DepthMapCollider(mesh, six_maps()),
                                                 physics::ExactDistance(mesh), mesh);
    if (!test.disagrees()) continue;
    context.warn(
        "body_hides_from_maps",
        fmt::format("{}: depth maps of frame {} take {:.2g} % of the points beside the body for inside and "
                    "{:.2g} % of those inside for outside, where no map sees it; collider = \"exact\" is "
                    "right there",
                    path_, i, 100 * test.false_inside_share(), 100 * test.false_outside_share()),
        path_, "body.collider");
    return;
  }
}

void WorldBody::add_to(physics::World& world) const {
  world.collider = rigid_ ? &rigid_->field : nullptr;
  world.body_motion = motion_;
  world.animated = animated_.get();
}

std::unique_ptr<physics::Collider> WorldBody::at_start() const {
  const physics::Pose here = physics::pose(animated_ ? physics::RigidMotion{} : motion_, 0);
  if (animated_) animated_->prepare(0, 0);
  const physics::Collider& shape =
      animated_ ? static_cast<const physics::Collider&>(*animated_) : rigid_->field;
  return std::make_unique<physics::PosedCollider>(shape, here);
}

std::unique_ptr<physics::Collider> WorldBody::precise_at_start() const {
  if (!rigid_) return nullptr;
  return std::make_unique<physics::PosedCollider>(rigid_->exact, physics::pose(motion_, 0));
}

double WorldBody::triangles_until(double seconds) const {
  if (!animated_) return 0;
  const std::vector<double>& times = frames_->times();
  const auto reached = std::upper_bound(times.begin(), times.end(), seconds) - times.begin() + 1;
  return double(triangles_.size()) * double(std::clamp<std::ptrdiff_t>(reached, 2, std::ssize(times)));
}

std::vector<physics::Vec3> WorldBody::vertices_at(double time) const {
  const std::vector<double>& times = frames_->times();
  const auto next = std::upper_bound(times.begin(), times.end(), time);
  if (next == times.begin()) return frames_->positions(0);
  if (next == times.end()) return frames_->positions(times.size() - 1);
  const auto i = static_cast<std::size_t>(next - times.begin());
  std::vector<physics::Vec3> x = frames_->positions(i - 1);
  const std::vector<physics::Vec3> y = frames_->positions(i);
  const double share = (time - times[i - 1]) / (times[i] - times[i - 1]);
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += share * (y[k] - x[k]);
  return x;
}

physics::Penetration WorldBody::penetration(std::vector<physics::Vec3> points, double time) const {
  if (animated_) return physics::penetration(physics::ExactDistance({vertices_at(time), triangles_}), points);
  const physics::Pose pose = physics::pose(motion_, time);
  if (!physics::is_identity(motion_))
    for (physics::Vec3& x : points) x = pose.to_body(x);
  return physics::penetration(rigid_->exact, points);
}

BodyEnd WorldBody::end_of(geometry::Mesh garment, double gap, double time) const {
  if (animated_) {
    const physics::TriangleMesh body{vertices_at(time), triangles_};
    return body_end(garment, body, physics::ExactDistance(body), gap);
  }
  const physics::Pose pose = physics::pose(motion_, time);
  if (!physics::is_identity(motion_))
    for (geometry::Point& p : garment.points()) p = bridge::to_cgal(pose.to_body(bridge::to_eigen(p)));
  return body_end(garment, rigid_->triangles, rigid_->exact, gap);
}

physics::Vec3 WorldBody::deepest_of(const std::vector<physics::Vec3>& points, double time) const {
  const auto deepest = [&](const physics::Collider& body) {
    return *std::min_element(
        points.begin(), points.end(),
        [&](const physics::Vec3& a, const physics::Vec3& b) { return body.at(a).value < body.at(b).value; });
  };
  if (points.empty()) return {0, 0, 0};
  if (animated_) return deepest(physics::ExactDistance({vertices_at(time), triangles_}));
  return deepest(physics::PosedCollider(rigid_->exact, physics::pose(motion_, time)));
}

int WorldBody::count_near(const std::vector<physics::Vec3>& points, double distance) const {
  if (rigid_)
    return physics::count_contacts(points, physics::PosedCollider(rigid_->field, physics::pose(motion_, 0)),
                                   distance);
  animated_->prepare(0, 0);
  return physics::count_contacts(points, *animated_, distance);
}

physics::PushOutReport WorldBody::push_out(std::vector<physics::Vec3>& points, const std::vector<int>& which,
                                           double time) const {
  constexpr double outside = 1e-6;  // [m], so that rounding leaves none inside
  if (!rigid_) return {};
  const physics::PosedCollider posed(rigid_->exact, physics::pose(motion_, time));
  return physics::push_out(points, which, posed, outside);
}

BodyOutline WorldBody::outline(double time) const {
  BodyOutline outline = rigid_ ? rigid_->outline : BodyOutline{};
  outline.box = box(time);
  return outline;
}

io::MeshFile WorldBody::at(double time, const Context& context) const {
  io::MeshFile file = read_mesh(path_, {with_unit(context.frame, unit_), context.listener, context.memory});
  const physics::Pose pose = physics::pose(motion_, time);
  std::vector<physics::Vec3> x = animated_ ? vertices_at(time) : bridge::positions_of(file.mesh);
  for (geometry::Vertex v : file.mesh->vertices())
    file.mesh->point(v) = bridge::to_cgal(animated_ ? x[v] : pose.to_world(x[v]));
  return file;
}

BodyEnd body_end(const geometry::Mesh& garment, const physics::TriangleMesh& body,
                 const physics::ExactDistance& exact, double gap) {
  std::vector<double> distances;
  BodyEnd end;
  end.gap = gap;
  for (const physics::Vec3& x : bridge::positions_of(garment)) {
    distances.push_back(exact.sample(x).value);
    end.vertices_inside += distances.back() < 0;
    end.depth = std::max(end.depth, -distances.back());
  }
  const bridge::FitPiercing through = bridge::measure_piercing(garment, body, exact, distances);
  end.pierced_faces = through.faces;
  end.depth = std::max(end.depth, through.deepest);
  return end;
}

Eigen::AlignedBox3d box_of(const std::vector<physics::Vec3>& points) {
  Eigen::AlignedBox3d box;
  for (const physics::Vec3& p : points) box.extend(p);
  return box;
}

Eigen::AlignedBox3d WorldBody::box(double time) const {
  if (animated_) return box_of(vertices_at(time));
  const physics::Pose pose = physics::pose(motion_, time);
  std::vector<physics::Vec3> x = rigid_->triangles.vertices;
  for (physics::Vec3& p : x) p = pose.to_world(p);
  return box_of(x);
}

namespace {

constexpr double edges_below = 0.95;  ///< all but so much is shorter
constexpr double graded_by_lines =
    1.25;  ///< percentiles by area and by count that differ more: lines refined places

/// Percentile of lengths that stand for an area of their square each.
double percentile_by_area(std::vector<double> lengths) {
  std::sort(lengths.begin(), lengths.end());
  double whole = 0, below = 0;
  for (double l : lengths) whole += l * l;
  for (double l : lengths)
    if ((below += l * l) >= edges_below * whole) return l;
  return lengths.back();
}

bool has_lines(const geometry::Mesh& garment) {
  const auto line = geometry::find_map(garment, geometry::attribute::line);
  return line && std::any_of(garment.vertices().begin(), garment.vertices().end(),
                             [&](geometry::Vertex v) { return (*line)[v] >= 0; });
}

}  // namespace

double edge_sag(const geometry::Mesh& garment) {
  constexpr double limb_radius = 0.05;
  std::vector<double> lengths;
  const auto rest = *geometry::find_map(garment, geometry::attribute::rest_length);
  for (geometry::Edge e : garment.edges()) lengths.push_back(rest[e]);
  if (geometry::is_chain(garment))
    for (const geometry::Strut& link : geometry::struts(garment)) lengths.push_back(link.rest_length);
  if (lengths.empty()) return 0;
  const auto at = lengths.begin() + static_cast<std::ptrdiff_t>(edges_below * double(lengths.size() - 1));
  std::nth_element(lengths.begin(), at, lengths.end());
  double length = *at;
  if (has_lines(garment))
    if (const double by_area = percentile_by_area(lengths); by_area > graded_by_lines * length)
      length = by_area;
  return length * length / (8 * limb_radius);
}

double contact_gap(double wanted, double field_tolerance, const io::MeshFile& garment) {
  const double sag = edge_sag(garment.mesh), gap = sag + 1.5 * field_tolerance;
  const auto record = io::find_wrinkle_record(garment);
  if (!record || !(record->contact_gap > 0)) return std::max(wanted, gap);
  return std::max(wanted, std::clamp(record->contact_gap, sag + field_tolerance, gap));
}

double contact_distance(double gap) { return 1.2 * gap; }

double contact_distance(const io::MeshFile& garment, const physics::ExactDistance& body) {
  if (const auto record = io::find_wrinkle_record(garment); record && record->contact_gap > 0)
    return contact_distance(record->contact_gap);
  io::MeshFile file = garment;
  geometry::ensure_rest_lengths(file.mesh);
  return contact_distance(contact_gap(physics::SimulateOptions{}.contact_gap, usual_tolerance(body), file));
}

}  // namespace furrow::jobs
