// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/drape_garment.h"

#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "bridge/gather.h"
#include "cli/pins.h"
#include "cli/prepare_garment.h"
#include "cli/scene_cloth.h"
#include "geometry/border_loops.h"
#include "geometry/rest_metric.h"
#include "io/animation_file.h"
#include "physics/elastic_band.h"

namespace furrow::cli {
namespace {

/// The way to rest, a frame an iteration of the finest level.
class WayRecorder {
 public:
  WayRecorder(const std::filesystem::path& path, int last_level, const CommonArguments& common)
      : path_(path), last_level_(last_level), common_(common) {}
  void observe(int level, const physics::Cloth& cloth) {
    if (path_.empty() || level < last_level_) return;
    if (!writer_) {
      geometry::Mesh mesh;
      for (const physics::Vec3& x : cloth.particles.x) mesh.add_vertex({x.x(), x.y(), x.z()});
      for (const auto& t : cloth.triangles)
        mesh.add_face(geometry::Vertex(t[0]), geometry::Vertex(t[1]), geometry::Vertex(t[2]));
      io::AnimationOptions options;
      options.frame = write_options(common_);
      writer_ = std::make_unique<io::AnimationWriter>(path_, mesh, options);
    }
    writer_->add(cloth.particles.x);
  }
  void close() {
    if (writer_) writer_->close();
  }

 private:
  const std::filesystem::path& path_;
  int last_level_;
  const CommonArguments& common_;
  std::unique_ptr<io::AnimationWriter> writer_;
};

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bridge::MakeCloth maker(const io::Scene& scene, io::MeshFile& made, const io::MeshFile& as_read,
                        const std::vector<Band>& bands, double band_stiffness,
                        const CommonArguments& common) {
  return [&, bands, band_stiffness](geometry::Mesh& mesh) {
    made = as_read;
    made.mesh = mesh;
    const auto pins = find_pins(made, scene.pins);
    complete_garment(made, scene.material);
    physics::Cloth cloth = bridge::gather(made.mesh, spring_options(made, scene.material));
    const auto loops = geometry::border_loops(made.mesh);
    for (const Band& band : bands) {
      std::vector<int> vertices;
      for (const geometry::Vertex v : loops[geometry::find_border_loop(loops, band.loop)].vertices)
        vertices.push_back(int(v));
      physics::add_elastic_band(cloth, vertices, {band.length, band_stiffness});
    }
    pin_cloth(cloth, pins, nullptr, 0, common);
    mesh = made.mesh;
    return cloth;
  };
}

/// As contact_gap() tells for the refined garment: its edges are half as long a level, their sag a quarter.
double gap_of(const io::Scene& scene, const BodyCollider& body, geometry::Mesh garment) {
  geometry::ensure_rest_lengths(garment);
  const double sag = contact_gap(0, 0, garment) / std::pow(4, scene.subdivide);
  return std::max(scene.simulation.contact_gap, sag + 1.5 * body.field.report().tolerance);
}

}  // namespace

Draped drape_garment(const io::Scene& scene, const BodyCollider& body, const DrapeSettings& s,
                     const CommonArguments& common) {
  Draped draped;
  io::Scene coarse = scene;
  coarse.subdivide = 0;
  const io::MeshFile as_read = begin_garment(coarse, common);
  bridge::DrapeOptions options;
  options.refinements = scene.subdivide;
  options.settle.gravity = scene.simulation.gravity;
  options.settle.friction = scene.simulation.friction;
  options.settle.tolerance = s.residual;
  options.plain = s.plain;
  options.settle.max_iterations = s.iterations.value_or(s.plain ? 20000 : options.settle.max_iterations);
  options.settle.gap = gap_of(scene, body, as_read.mesh);
  options.settle.threads = int(std::max(1u, std::thread::hardware_concurrency()));
  WayRecorder way(s.animation, scene.subdivide, common);
  Progress progress("draping", common);
  double first = 0;
  const auto observe = [&](int level, const physics::SettleProgress& p, const physics::Cloth& cloth) {
    way.observe(level, cloth);
    if (p.iteration == 0 || p.residual > first) first = p.residual;
    const double way_there = std::log(first / p.residual) / std::log(first / options.settle.tolerance);
    progress.show((level + std::clamp(way_there, 0.0, 1.0)) / (scene.subdivide + 1));
    return !interrupted();
  };
  const double start = now();
  geometry::Mesh mesh = as_read.mesh;
  physics::Cloth cloth;
  draped.report =
      bridge::drape(mesh, cloth, &body.field, options,
                    maker(scene, draped.file, as_read, s.bands, s.band_stiffness, common), observe);
  draped.seconds = now() - start;
  draped.file.mesh = std::move(mesh);
  way.close();
  draped.fit_options.contact_distance = 1.2 * options.settle.gap;
  draped.fit = bridge::fit_report(draped.file.mesh, body.triangles, body.exact, draped.fit_options);
  return draped;
}

}  // namespace furrow::cli
