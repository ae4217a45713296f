// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/run/drape_garment.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <thread>

#include "bridge/convert.h"
#include "bridge/gather.h"
#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/struts.h"
#include "geometry/mesh/vertex_attributes.h"
#include "geometry/rest/rest_metric.h"
#include "io/animation/animation_file.h"
#include "jobs/read_inputs.h"
#include "jobs/run/gate.h"
#include "jobs/run/pins.h"
#include "jobs/run/prepare_garment.h"
#include "jobs/run/scene_cloth.h"
#include "physics/body/collider.h"
#include "physics/cloth/elastic_band.h"

namespace furrow::jobs {
namespace {

/// The way to rest, a frame an iteration of the finest level.
class WayRecorder {
 public:
  WayRecorder(const std::filesystem::path& path, int last_level, const Context& context)
      : path_(path), last_level_(last_level), context_(context) {}
  void observe(int level, const physics::Cloth& cloth) {
    if (path_.empty() || level < last_level_) return;
    if (!writer_) {
      geometry::Mesh mesh;
      for (const physics::Vec3& x : cloth.particles.x) mesh.add_vertex({x.x(), x.y(), x.z()});
      for (const auto& t : cloth.triangles)
        mesh.add_face(geometry::Vertex(t[0]), geometry::Vertex(t[1]), geometry::Vertex(t[2]));
      io::AnimationOptions options;
      options.frame = write_options(context_.frame);
      writer_ = std::make_unique<io::AnimationWriter>(path_, mesh, options);
    }
    writer_->add(cloth.particles.x);
  }
  /// Whether there is anything to see.
  bool close() {
    if (writer_) writer_->close();
    return writer_ != nullptr;
  }

 private:
  const std::filesystem::path& path_;
  int last_level_;
  const Context& context_;
  std::unique_ptr<io::AnimationWriter> writer_;
};

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A vertex of the loop that a name means on the mesh as it was read: refinement keeps its index, but may
/// change which loop is the longest.
int vertex_of_loop(const geometry::Mesh& mesh, const std::string& name) {
  const auto loops = geometry::border_loops(mesh);
  return int(loops[geometry::find_border_loop(loops, name)].vertices.at(0));
}

std::vector<int> loop_through(const geometry::Mesh& mesh, int vertex) {
  for (const geometry::BorderLoop& loop : geometry::border_loops(mesh)) {
    std::vector<int> vertices;
    for (const geometry::Vertex v : loop.vertices) vertices.push_back(int(v));
    if (std::find(vertices.begin(), vertices.end(), vertex) != vertices.end()) return vertices;
  }
  return {};
}

/// As struts, so that the garment's file has them; a band that was there is taken off.
void sew_band(geometry::Mesh& mesh, const std::vector<int>& loop,
              const physics::ElasticBandOptions& options) {
  physics::Cloth band;
  band.particles.x = bridge::positions_of(mesh);
  physics::add_elastic_band(band, loop, options);
  std::vector<geometry::Strut> all = geometry::struts(mesh);
  std::erase_if(all, [&](const geometry::Strut& s) {
    return std::any_of(band.bending.begin(), band.bending.end(),
                       [&](const physics::Spring& b) { return int(s.a) == b.a && int(s.b) == b.b; });
  });
  using Index = geometry::Vertex::size_type;
  for (const physics::Spring& s : band.bending)
    all.push_back({geometry::Vertex(Index(s.a)), geometry::Vertex(Index(s.b)), s.rest_length, s.stiffness});
  geometry::set_struts(mesh, all);
}

/// Vertices of a garment that was measured.
std::size_t count_nearer(const geometry::Mesh& mesh, double distance) {
  std::size_t n = 0;
  for (const geometry::VertexAttribute& a : geometry::vertex_attributes(mesh))
    if (a.name == bridge::fit_distance)
      for (geometry::Vertex v : mesh.vertices()) n += a.values[v] < distance;
  return n;
}

/// Makes cloth of the garment on each level; pins and bands are found again there.
class Maker {
 public:
  /// Throws std::invalid_argument for a pin's or a band's loop that the garment does not have.
  Maker(const io::Scene& scene, const BodyCollider& body, const DrapeSettings& settings,
        const io::MeshFile& as_read, const Context& context)
      : scene_(scene), body_(body), settings_(settings), as_read_(as_read), context_(context) {
    for (const io::ScenePins& pins : scene.pins)
      pin_vertices_.push_back(pins.loop.empty() ? -1 : vertex_of_loop(as_read.mesh, pins.loop));
    for (const Band& band : settings.bands) try {
        band_vertices_.push_back(vertex_of_loop(as_read.mesh, band.loop));
      } catch (const std::invalid_argument& e) {
        throw std::invalid_argument("--band: " + std::string(e.what()));
      }
  }

  physics::Cloth operator()(geometry::Mesh& mesh) {
    made = as_read_;
    made.mesh = mesh;
    const auto pins = find_pins(made, pins_on(mesh));
    complete_garment(made, scene_.material);
    for (std::size_t i = 0; i < band_vertices_.size(); ++i)
      sew_band(made.mesh, loop_through(mesh, band_vertices_[i]),
               {settings_.bands[i].length, settings_.band_stiffness});
    physics::Cloth cloth = naming(scene_.garment.string(), [&] {
      return bridge::gather(made.mesh, spring_options(made, scene_.material));
    });
    pin_cloth(cloth, pins, nullptr, 0, context_);
    int moved = 0;
    for (const std::vector<int>& held : pins)
      moved += physics::push_out(cloth.particles.x, held, body_.exact).moved;
    if (moved)
      context_.warn("pins_inside_body",
                    std::to_string(moved) + " of " + std::to_string(mesh.number_of_vertices()) +
                        " vertices are pinned inside the body; moved onto it",
                    "pins");
    mesh = made.mesh;
    return cloth;
  }

  io::MeshFile made;  ///< of the last level

 private:
  std::vector<io::ScenePins> pins_on(const geometry::Mesh& mesh) const {
    std::vector<io::ScenePins> result = scene_.pins;
    for (std::size_t i = 0; i < result.size(); ++i) {
      if (pin_vertices_[i] < 0) continue;
      const std::vector<int> loop = loop_through(mesh, pin_vertices_[i]);
      result[i].loop.clear();
      result[i].vertices.insert(result[i].vertices.end(), loop.begin(), loop.end());
    }
    return result;
  }

  const io::Scene& scene_;
  const BodyCollider& body_;
  const DrapeSettings& settings_;
  const io::MeshFile& as_read_;
  const Context& context_;
  std::vector<int> pin_vertices_, band_vertices_;
};

/// Of the refined garment: its edges are half as long a level, their sag a quarter.
double refined_sag(geometry::Mesh garment, int levels) {
  geometry::ensure_rest_lengths(garment);
  return edge_sag(garment) / std::pow(4, levels);
}

/// What is wanted, or what the sag and the field's tolerance need; warns where that is much more.
double gap_of(const io::Scene& scene, const BodyCollider& body, const geometry::Mesh& garment,
              const Context& context) {
  const double wanted = scene.simulation.contact_gap, tolerance = body.field.report().tolerance;
  const double sag = refined_sag(garment, scene.subdivide), gap = std::max(wanted, sag + tolerance);
  if (gap > 1.5 * wanted)
    context.warn(
        "gap_raised",
        scene.garment.stem().string() + ": keeps " + millimetres(gap) + " from the body, not " +
            millimetres(wanted) + ", so strain and ease come out too large; " +
            (sag > tolerance ? "its edges are long: with --subdivide " + std::to_string(scene.subdivide + 1) +
                                   " it is " + millimetres(std::max(wanted, sag / 4 + tolerance))
                             : "--tolerance asks for a finer field of the body"),
        scene.garment.string(), sag > tolerance ? "garment.subdivide" : "body.tolerance");
  return gap;
}

}  // namespace

Draped drape_garment(const io::Scene& scene, const BodyCollider& body, const DrapeSettings& s,
                     const Context& context) {
  Draped draped;
  io::Scene coarse = scene;
  coarse.subdivide = 0;
  const io::MeshFile as_read = begin_garment(coarse, context);
  require_refinement(as_read.mesh.number_of_faces(), 4, scene.subdivide, "--subdivide", context);
  bridge::DrapeOptions options;
  options.refinements = scene.subdivide;
  options.settle.gravity = scene.simulation.gravity;
  options.settle.friction = scene.simulation.friction;
  options.settle.tolerance = s.residual;
  if (s.contact_depth) options.settle.contact_depth = *s.contact_depth;
  options.plain = s.plain;
  options.bending_friction = s.bending_friction;
  options.settle.max_iterations = s.iterations.value_or(s.plain ? 20000 : options.settle.max_iterations);
  options.settle.gap = gap_of(scene, body, as_read.mesh, context);
  options.settle.threads =
      scene.threads ? scene.threads : int(std::max(1u, std::thread::hardware_concurrency()));
  if (scene.subdivide > 0 && !geometry::struts(as_read.mesh).empty())
    context.warn("struts_dropped",
                 "--subdivide drops the struts that the garment has, its bands among them; say --band again",
                 "garment.subdivide", "bands");
  WayRecorder way(s.animation, scene.subdivide, context);
  const ProgressScope progress(context.listener, "draping");
  double first = 0;
  const auto observe = [&](int level, const physics::SettleProgress& p, const physics::Cloth& cloth) {
    way.observe(level, cloth);
    if (p.iteration == 0 || p.residual > first) first = p.residual;
    const double least = options.settle.tolerance;
    const bool far = std::isfinite(p.residual) && p.residual > least && first > least;
    const double way_there = far ? std::log(first / p.residual) / std::log(first / least) : 1;
    return progress((level + std::clamp(way_there, 0.0, 1.0)) / (scene.subdivide + 1));
  };
  const double start = now();
  geometry::Mesh mesh = as_read.mesh;
  physics::Cloth cloth;
  Maker maker(scene, body, s, as_read, context);
  draped.report = bridge::drape(mesh, cloth, &body.field, options, std::ref(maker), observe);
  draped.seconds = now() - start;
  draped.file = std::move(maker.made);
  draped.file.mesh = std::move(mesh);
  draped.animated = way.close();
  draped.falls = draped.report.levels.back().settle.touching == 0 && !scene.simulation.gravity.isZero() &&
                 std::none_of(cloth.particles.inv_mass.begin(), cloth.particles.inv_mass.end(),
                              [](double w) { return w == 0; });
  draped.gap = options.settle.gap;
  draped.fit_options.contact_distance = contact_distance(draped.gap);
  draped.fit = bridge::fit_report(draped.file.mesh, body.triangles, body.exact, draped.fit_options);
  if (draped.gap == scene.simulation.contact_gap)
    draped.too_near = count_nearer(draped.file.mesh, 0.9 * draped.gap - body.field.report().tolerance);
  return draped;
}

}  // namespace furrow::jobs
