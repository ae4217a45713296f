// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/drape.h"

#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <sstream>
#include <thread>

#include "bridge/fit_report.h"
#include "bridge/gather.h"
#include "cli/body.h"
#include "cli/camera_options.h"
#include "cli/drape_report.h"
#include "cli/fit_output.h"
#include "cli/pins.h"
#include "cli/prepare_garment.h"
#include "cli/run_warnings.h"
#include "cli/scene_cloth.h"
#include "cli/scene_flags.h"
#include "cli/scene_input.h"
#include "cli/subcommands.h"
#include "geometry/border_loops.h"
#include "geometry/errors.h"
#include "geometry/property_names.h"
#include "geometry/rest_metric.h"
#include "io/animation_file.h"
#include "physics/elastic_band.h"

namespace furrow::cli {
namespace {

struct DrapeArguments : CommonArguments {
  std::string in, picture, colour = "strain", compare, animation;
  std::optional<int> subdivide, iterations;
  bool plain = false;
  double residual = physics::SettleOptions{}.tolerance;
  std::vector<std::string> bands;
  double band_stiffness = physics::ElasticBandOptions{}.stiffness;
  SceneFlags flags;
  CameraArguments camera;
  bool view_chosen = false;
};

/// A border loop's name, and the band's length over the loop's.
struct Band {
  std::string loop;
  double length;
};

std::vector<Band> bands_of(const DrapeArguments& a) {
  std::vector<Band> bands;
  for (const std::string& text : a.bands) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError(
          "--band takes a border loop and the band's length over the loop's, as in top=0.9, not '" + text +
          "'");
    bands.push_back({text.substr(0, equals), parse_numbers(text.substr(equals + 1), 1, "--band")[0]});
  }
  return bands;
}

std::vector<std::string> fabrics_of(const DrapeArguments& a) {
  std::istringstream stream(a.compare);
  std::vector<std::string> names;
  for (std::string name; std::getline(stream, name, ',');) names.push_back(name);
  return names;
}

void check_call(const DrapeArguments& a, const io::Scene& scene) {
  if (!scene.body) throw UsageError("a garment is draped on a body: name one with --body");
  if (!scene.body->frames.empty())
    throw UsageError("--body-frames: drape fits a garment to one pose; simulate moves it");
  if (!scene.lines.empty())
    throw UsageError("drape draws no lines; draw them on what it writes, with furrow wrinkle");
  if (a.out.empty() && a.picture.empty() && a.animation.empty())
    throw UsageError("nothing to write: name --output, --picture or --animation");
  if (!a.compare.empty() && a.picture.empty())
    throw UsageError("--compare is a picture: name it with --picture");
  if (!a.compare.empty() && (!a.out.empty() || !a.animation.empty()))
    throw UsageError("--compare writes a picture only; drape each by itself for its mesh");
  if (!(a.residual > 0)) throw UsageError("--residual takes a number > 0");
  if (a.picture.empty() && (a.view_chosen || !a.camera.save_camera.empty()))
    throw UsageError("a view and --save-camera are of use with --picture only");
  if (!a.out.empty()) check_output(a.out);
  check_picture(a.picture, "--picture");
  check_folder(a.camera.save_camera);
  if (!a.animation.empty() && !io::animation_format(a.animation))
    throw UsageError(a.animation + ": the ending names no animation; choose pc2, mdd or glb");
  check_folder(a.animation);
  std::vector<std::string> inputs{scene.garment.string(), scene.body->mesh.string(),
                                  scene.body->field.string(), a.camera.camera};
  if (is_scene(a.in)) inputs.push_back(a.in);
  refuse_same({a.out, a.picture, a.animation, a.camera.save_camera}, inputs);
}

/// Cotton, unless something is said of what the cloth is.
void choose_fabric(io::TomlDocument& document) {
  const io::Json material = document.root.value("material", io::Json::object());
  for (const char* key : {"preset", "membrane", "bending_law", "stretch", "stiffness"})
    if (material.contains(key)) return;
  io::set_value(document, "material.preset", "cotton", "furrow drape");
}

/// The way to rest, a frame an iteration of the finest level.
class WayRecorder {
 public:
  WayRecorder(const DrapeArguments& a, int last_level) : a_(a), last_level_(last_level) {}
  void observe(int level, const physics::Cloth& cloth) {
    if (a_.animation.empty() || level < last_level_) return;
    if (!writer_) {
      geometry::Mesh mesh;
      for (const physics::Vec3& x : cloth.particles.x) mesh.add_vertex({x.x(), x.y(), x.z()});
      for (const auto& t : cloth.triangles)
        mesh.add_face(geometry::Vertex(t[0]), geometry::Vertex(t[1]), geometry::Vertex(t[2]));
      io::AnimationOptions options;
      options.frame = write_options(a_);
      writer_ = std::make_unique<io::AnimationWriter>(a_.animation, mesh, options);
    }
    writer_->add(cloth.particles.x);
  }
  void close() {
    if (writer_) writer_->close();
  }

 private:
  const DrapeArguments& a_;
  int last_level_;
  std::unique_ptr<io::AnimationWriter> writer_;
};

struct Draped {
  io::MeshFile file;
  bridge::DrapeReport report;
  bridge::FitReport fit;
  bridge::FitOptions fit_options;
  double seconds = 0;
  std::string name;
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

Draped drape_one(const io::Scene& scene, const BodyCollider& body, const DrapeArguments& a,
                 const CommonArguments& common) {
  Draped draped;
  io::Scene coarse = scene;
  coarse.subdivide = 0;
  const io::MeshFile as_read = begin_garment(coarse, common);
  bridge::DrapeOptions options;
  options.refinements = scene.subdivide;
  options.settle.gravity = scene.simulation.gravity;
  options.settle.friction = scene.simulation.friction;
  options.settle.tolerance = a.residual;
  options.plain = a.plain;
  options.settle.max_iterations = a.iterations.value_or(a.plain ? 20000 : options.settle.max_iterations);
  options.settle.gap = gap_of(scene, body, as_read.mesh);
  options.settle.threads = int(std::max(1u, std::thread::hardware_concurrency()));
  WayRecorder way(a, scene.subdivide);
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
                    maker(scene, draped.file, as_read, bands_of(a), a.band_stiffness, common), observe);
  draped.seconds = now() - start;
  draped.file.mesh = std::move(mesh);
  way.close();
  draped.fit_options.contact_distance = 1.2 * options.settle.gap;
  draped.fit = bridge::fit_report(draped.file.mesh, body.triangles, body.exact, draped.fit_options);
  return draped;
}

void write_picture(std::vector<Draped>& all, const io::Scene& scene, const DrapeArguments& a,
                   const CommonArguments& common) {
  const auto quantity = a.colour == "distance" ? io::FitQuantity::distance : io::FitQuantity::strain;
  const io::FitScale scale = fit_scale(quantity, all[0].fit_options);
  const io::MeshFile body = io::read_mesh(scene.body->mesh, read_options(common));
  std::vector<FitPanel> panels;
  for (Draped& d : all) {
    colour_garment(d.file.mesh, scale);
    const std::string caption =
        d.name + (all.size() > 1 ? "\n" : ": ") + fit_words(d.fit, d.fit_options, quantity);
    panels.push_back({&d.file.mesh, &body.mesh, caption});
  }
  io::write_png(a.picture, fit_picture(panels, scale, a.camera, a.view_chosen, common));
}

int drape(const DrapeArguments& a) {
  catch_interrupts();
  io::TomlDocument document = scene_settings(a.in, "", std::nullopt, a.flags, a);
  const std::filesystem::path folder = is_scene(a.in) ? std::filesystem::path(a.in).parent_path() : "";
  choose_fabric(document);
  io::Scene scene = scene_of(document, folder);
  if (scene.garment.empty()) throw UsageError(document.name + ": garment.mesh is missing");
  check_inputs(scene, document, -1);
  take_noted_frame(scene, document);
  if (a.subdivide) scene.subdivide = *a.subdivide;
  check_call(a, scene);
  bands_of(a);
  CommonArguments common = a;
  common.unit = scene.unit;
  common.up = scene.up;
  const BodyCollider body = load_body(*scene.body, common);
  std::vector<Draped> all;
  std::vector<std::string> fabrics = fabrics_of(a);
  if (fabrics.empty()) fabrics.push_back("");
  for (const std::string& fabric : fabrics) {
    io::Scene one = scene;
    if (!fabric.empty()) {
      io::TomlDocument other = document;
      io::set_value(other, "material.preset", fabric, "--compare");
      one = scene_of(other, folder);
      one.subdivide = scene.subdivide;
    }
    all.push_back(drape_one(one, body, a, common));
    all.back().name = fabric.empty() ? scene.garment.stem().string() : fabric;
    if (all.back().report.stopped) break;
  }
  if (!a.out.empty()) write_mesh(all[0].file, common);
  if (!a.picture.empty()) write_picture(all, scene, a, common);
  std::vector<DrapedRow> rows;
  for (const Draped& d : all) rows.push_back({d.name, &d.report, &d.fit, &d.fit_options, d.seconds});
  Json report = to_json(rows);
  if (!a.out.empty()) report["written"] = a.out;
  if (!a.picture.empty()) report["picture"] = a.picture;
  print_report(report, common);
  return exit_code_of(rows, common);
}

}  // namespace

void add_drape(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<DrapeArguments>();
  a->camera.size = "900,1100";
  CLI::App* sub = app.add_subcommand(
      "drape",
      "Put a finished garment on a body: how it comes to rest, and how it fits\n\n"
      "  furrow drape shirt.obj --body body.obj --subdivide 1 -o worn.ply --picture fit.png\n"
      "  furrow drape skirt.obj --body body.obj --fabric silk --band top=0.95 -o worn.ply\n"
      "  furrow drape shirt.obj --body body.obj --compare cotton,silk,denim --picture fabrics.png");
  sub->add_option("garment", a->in,
                  "garment to read, where it lies on the body or about it, or a scene: a .toml file")
      ->required();
  sub->add_option("-o,--output", a->out,
                  "mesh to write: the garment as it is worn; PLY keeps strain and distance");
  sub->add_option("--subdivide", a->subdivide,
                  "refine the garment so many times (Loop); its shape is found coarse to fine")
      ->check(CLI::Range(0, 6));
  sub->add_option("--picture", a->picture, "PNG to write: the garment on the body, coloured, with a legend");
  sub->add_option("--colour", a->colour, "of the picture: strain (default) or distance")
      ->check(CLI::IsMember({"strain", "distance"}));
  sub->add_option("--compare", a->compare, "fabrics parted by commas: one picture of them all");
  sub->add_option("--animation", a->animation,
                  "the way to rest, not a motion in time: a frame an iteration; pc2, mdd or glb");
  sub->add_option(
         "--band", a->bands,
         "an elastic band along a border loop and its length over the loop's: top=0.9; may be given again")
      ->allow_extra_args(false);
  sub->add_option("--band-stiffness", a->band_stiffness,
                  "force in a band at twice its length [N] (default 50)")
      ->check(CLI::NonNegativeNumber);
  sub->add_option("--residual", a->residual,
                  "largest net force on a vertex, over its weight, at which it rests (default 0.001)");
  sub->add_flag("--plain", a->plain,
                "paper 2's own scheme: forces used as displacements, with a cap; to compare with");
  sub->add_option("--iterations", a->iterations, "at most, on each level (default 200; --plain: 20000)")
      ->check(CLI::NonNegativeNumber);
  a->flags.add_to(*sub, true);
  add_camera_options(*sub, a->camera);
  add_common_options(*sub, *a);
  sub->callback([a, sub, &exit_code] {
    for (const char* option : {"--view", "--camera", "--eye", "--target"})
      a->view_chosen = a->view_chosen || sub->count(option) > 0;
    exit_code = drape(*a);
  });
}

}  // namespace furrow::cli
