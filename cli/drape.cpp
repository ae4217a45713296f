// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>

#include "cli/body.h"
#include "cli/camera_options.h"
#include "cli/drape_checks.h"
#include "cli/drape_garment.h"
#include "cli/drape_report.h"
#include "cli/fit_output.h"
#include "cli/recorded_material.h"
#include "cli/scene_flags.h"
#include "cli/scene_input.h"
#include "cli/subcommands.h"
#include "io/animation/animation_file.h"

namespace furrow::cli {
namespace {

struct DrapeArguments : CommonArguments {
  std::string in, picture, colour = "strain", animation;
  std::optional<std::string> compare;
  std::optional<int> subdivide;
  DrapeSettings settings;
  std::vector<std::string> bands;
  SceneFlags flags;
  CameraArguments camera;
  bool view_chosen = false;
};

void check_call(const DrapeArguments& a, const io::Scene& scene) {
  if (!scene.body) throw UsageError("a garment is draped on a body: name one with --body");
  if (!scene.body->frames.empty())
    throw UsageError("--body-frames: drape fits a garment to one pose; simulate moves it");
  if (!physics::at_rest(scene.body->motion))
    throw UsageError("body.motion: drape takes the body as it lies in its file; move it there, or simulate");
  if (!scene.lines.empty())
    throw UsageError("drape draws no lines; draw them on what it writes, with furrow wrinkle");
  if (a.out.empty() && a.picture.empty() && a.animation.empty())
    throw UsageError("nothing to write: name --output, --picture or --animation");
  if (a.compare && a.picture.empty()) throw UsageError("--compare is a picture: name it with --picture");
  if (a.compare && (!a.out.empty() || !a.animation.empty()))
    throw UsageError("--compare writes a picture only; drape each by itself for its mesh");
  if (!(a.settings.residual > 0)) throw UsageError("--residual takes a number > 0");
  if (a.settings.plain && a.settings.contact_depth)
    throw UsageError("--contact-depth: --plain moves cloth out to the gap at once; leave one of them away");
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

/// What the garment's file notes, or cotton, unless something is said of what the cloth is.
void choose_fabric(io::TomlDocument& document, const std::filesystem::path& garment) {
  take_recorded_material(document, garment, nullptr);
  if (!names_cloth(document)) io::set_value(document, "material.preset", "cotton", "furrow drape");
}

DrapedRow row_of(const Draped& d, const DrapeSettings& settings) {
  return {d.name, &d.report, &d.fit, &d.fit_options, d.seconds, d.gap, d.too_near, settings.penetration,
          d.falls};
}

void write_picture(std::vector<Draped>& all, const io::Scene& scene, const DrapeArguments& a,
                   const CommonArguments& common) {
  const auto quantity = a.colour == "distance" ? io::FitQuantity::distance : io::FitQuantity::strain;
  const io::FitScale scale = fit_scale(quantity, all[0].fit_options);
  CommonArguments silent = common;  // its repairs are told already
  silent.quiet = true;
  const io::MeshFile body = read_mesh(scene.body->mesh.string(), silent);
  std::vector<FitPanel> panels;
  for (Draped& d : all) {
    colour_garment(d.file.mesh, scale);
    const std::string outcome = outcome_of(row_of(d, a.settings));
    const std::string caption = d.name + (outcome == "at rest" ? "" : " (" + outcome + ")") +
                                (all.size() > 1 ? "\n" : ": ") + fit_words(d.fit, d.fit_options, quantity);
    panels.push_back({&d.file.mesh, &body.mesh, caption});
  }
  io::write_png(a.picture, fit_picture(panels, scale, a.camera, a.view_chosen, common));
}

/// One for each fabric, or the scene alone.
std::vector<io::Scene> scenes_of(const io::Scene& scene, const io::TomlDocument& document,
                                 const std::filesystem::path& folder,
                                 const std::vector<std::string>& fabrics) {
  if (fabrics.empty()) return {scene};
  if (document.root.contains("/material/preset"_json_pointer) && !document.is_of_file("material.preset"))
    throw UsageError("--fabric: --compare names the fabrics; leave one of them away");
  std::vector<io::Scene> scenes;
  for (const std::string& fabric : fabrics) {
    io::TomlDocument other = document;
    io::set_value(other, "material.preset", fabric, "--compare");
    scenes.push_back(scene_of(other, folder));
    scenes.back().subdivide = scene.subdivide;
  }
  return scenes;
}

/// On stderr: which of the files that were asked for there are.
void tell_interruption(const DrapeArguments& a, bool drawn, bool animated) {
  std::string written, missing;
  const auto add = [&](const std::string& path, bool there) {
    std::string& list = there ? written : missing;
    if (!path.empty()) list += (list.empty() ? "" : ", ") + path;
  };
  add(a.out, true);
  add(a.picture, drawn);
  add(a.animation, animated);
  std::cerr << "error: interrupted; " << (written.empty() ? "nothing was written" : "written: " + written)
            << (missing.empty() ? "" : "; not written: " + missing) << '\n';
}

int drape(const DrapeArguments& a) {
  catch_interrupts();
  io::TomlDocument document = scene_settings(a.in, "", std::nullopt, a.flags, a);
  const std::filesystem::path folder = is_scene(a.in) ? std::filesystem::path(a.in).parent_path() : "";
  warn_of_unused_settings(document, a);
  if (!a.compare) choose_fabric(document, scene_of(document, folder).garment);
  io::Scene scene = scene_of(document, folder);
  if (scene.garment.empty()) throw UsageError(document.name + ": garment.mesh is missing");
  check_inputs(scene, document, -1);
  take_noted_frame(scene, document);
  if (a.subdivide) scene.subdivide = *a.subdivide;
  check_call(a, scene);
  DrapeSettings settings = a.settings;
  settings.bands = parse_bands(a.bands);
  settings.animation = a.animation;
  CommonArguments common = a;
  common.unit = scene.unit;
  common.up = scene.up;
  const std::vector<std::string> fabrics = a.compare ? parse_fabrics(*a.compare) : std::vector<std::string>{};
  const std::vector<io::Scene> scenes = scenes_of(scene, document, folder, fabrics);
  const BodyCollider body = load_body(*scene.body, common);
  std::vector<Draped> all;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    all.push_back(drape_garment(scenes[i], body, settings, common));
    all.back().name = fabrics.empty() ? scene.garment.stem().string() : fabrics[i];
    if (all.back().report.stopped) break;
  }
  if (!a.out.empty()) {
    note_material(all[0].file, document, all[0].gap);
    write_mesh(all[0].file, common);
  }
  const bool draws = !a.picture.empty() && !interrupted();  // that may take longer than the fit
  if (draws) write_picture(all, scene, a, common);
  std::vector<DrapedRow> rows;
  for (const Draped& d : all) rows.push_back(row_of(d, settings));
  Json report = to_json(rows);
  if (!a.out.empty()) report["written"] = a.out;
  if (draws) report["picture"] = a.picture;
  if (all[0].animated) report["animation"] = a.animation;
  print_report(report, common);
  const int code = exit_code_of(rows, common);
  if (interrupted()) tell_interruption(a, draws, all[0].animated);
  return code == exit_ok && interrupted() ? exit_interrupted : code;
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
  sub->add_option("--band-stiffness", a->settings.band_stiffness,
                  "force in a band at twice its length [N] (default 50)")
      ->check(CLI::NonNegativeNumber);
  sub->add_option(
         "--bending-friction", a->settings.bending_friction,
         "internal friction of bending: the moment that a metre of crease bears before it gives way [N] "
         "(default 0; half of Kawabata's 2HB)")
      ->check(CLI::NonNegativeNumber);
  sub->add_option("--residual", a->settings.residual,
                  "largest net force on a vertex, over its weight, at which it rests (default 0.001)");
  sub->add_option(
         "--contact-depth", a->settings.contact_depth,
         "go on, with contact ever stiffer, until nothing lies deeper in the gap than this [m]: "
         "1e-6 gives tight cloth its full strain, in about twice the time (default: as it comes, some "
         "0.1 mm)")
      ->check(CLI::Range(1e-7, 1.0));
  sub->add_option("--penetration", a->settings.penetration,
                  "depth to which the body may come through the cloth, between vertices, too [m] (default "
                  "0.005); beyond it the exit code is 4")
      ->check(CLI::NonNegativeNumber);
  sub->add_flag("--plain", a->settings.plain,
                "paper 2's own scheme: forces used as displacements, with a cap; to compare with");
  sub->add_option("--iterations", a->settings.iterations,
                  "at most, on each level (default 200; --plain: 20000)")
      ->check(CLI::NonNegativeNumber);
  a->flags.add_to(*sub, io::used_by::drape);
  add_camera_options(*sub, a->camera);
  add_common_options(*sub, *a);
  sub->callback([a, sub, &exit_code] {
    for (const char* option : {"--view", "--camera", "--eye", "--target"})
      a->view_chosen = a->view_chosen || sub->count(option) > 0;
    exit_code = drape(*a);
  });
}

}  // namespace furrow::cli
