// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/fabric.h"

#include <fmt/format.h>

#include <memory>
#include <ostream>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "io/base/atomic_file.h"
#include "io/picture/png_file.h"
#include "io/picture/render_scene.h"
#include "io/picture/render_weave.h"
#include "io/picture/strip.h"
#include "io/scene/fabrics.h"
#include "jobs/check/gate.h"

namespace furrow::cli {
namespace {

struct FabricArguments : CommonArguments {
  std::string action, name, picture;
  int rings = 20;
  std::optional<double> drape;
};

Json figures_of(const io::Fabric& f) {
  Json json{{"name", f.name}, {"density", f.density}, {"stretch", f.stretch}, {"rigidity", f.rigidity}};
  const io::FabricThreads& t = f.threads;
  json["threads"] = t.any();
  const auto add = [&](const char* key, double value) { json[key] = t.any() ? Json(value) : Json(nullptr); };
  add("warp_stretch", t.warp), add("weft_stretch", t.weft), add("thread_shear", t.shear);
  add("warp_rigidity", t.bend_warp), add("bias_rigidity", t.bend_bias), add("weft_rigidity", t.bend_weft);
  json["measured_drape"] = t.drape > 0 ? Json(t.drape) : Json(nullptr);
  return json;
}

Json details_of(const io::Fabric& f) {
  Json json = figures_of(f);
  json["thread_poisson"] = f.threads.any() ? Json(f.threads.poisson) : Json(nullptr);
  json["thickness"] = f.thickness, json["damping"] = f.damping, json["friction"] = f.friction;
  json["source"] = f.source, json["assumed"] = f.assumed;
  return json;
}

std::string known_fabrics() {
  std::string names;
  for (const io::Fabric& f : io::fabrics()) names += (names.empty() ? "" : ", ") + std::string(f.name);
  return names;
}

const io::Fabric& find_fabric(const FabricArguments& a) {
  if (a.name.empty()) throw UsageError("fabric " + a.action + ": name a fabric, one of " + known_fabrics());
  for (const io::Fabric& f : io::fabrics())
    if (a.name == f.name) return f;
  throw UsageError("there is no fabric '" + a.name + "'; furrow fabric list has " + known_fabrics());
}

io::SceneMaterial material_of_fabric(const std::string& name) {
  return jobs::material_of_settings(Json{{"preset", name}});
}

io::Panel panel_of(const geometry::Mesh& mesh, const std::string& words, double elevation) {
  io::RenderScene scene;
  scene.meshes.push_back(io::render_mesh_from(mesh));
  scene.lines = io::weave_lines_from(mesh, io::weave_spacing(mesh) * 1.6);
  io::RenderOptions options;
  options.width = options.height = 480;
  options.view.elevation_deg = elevation;
  return {io::render(scene, options), words};
}

/// The draped disc, and swatches pulled by 10 % at 0, 45 and 90 degrees.
void draw_fabric(const FabricArguments& a, const io::SceneMaterial& material, const DiscReport& disc,
                 Json& json) {
  std::vector<io::Panel> panels{
      panel_of(disc.mesh, fmt::format("drape coefficient {:.2f}", disc.coefficient), 35)};
  for (const double angle : {0., 45., 90.}) {
    const SwatchReport s = jobs::pull_swatch(material, angle, 0.1);
    json["swatches"].push_back({{"angle", angle},
                                {"strain", 0.1},
                                {"force", s.force},
                                {"modulus", s.modulus},
                                {"modulus_of_long_strip", s.wanted},
                                {"rested", s.rested}});
    panels.push_back(panel_of(s.mesh, fmt::format("{:.0f} degrees: {:.3g} N/m", angle, s.force), 85));
  }
  io::write_png(a.picture, io::strip(panels));
  json["picture"] = a.picture;
}

Json json_of(const DiscReport& r) {
  return {
      {"coefficient", r.coefficient}, {"least", r.least},   {"most", r.most},     {"nodes", r.nodes},
      {"energy", r.energy},           {"starts", r.starts}, {"rested", r.rested}, {"vertices", r.vertices}};
}

DiscJob disc_job(const FabricArguments& a, const io::SceneMaterial& material) {
  DiscJob job;
  job.material = material;
  job.rings = a.rings;
  return job;
}

int show(const FabricArguments& a, Listener& listener) {
  const io::Fabric& fabric = find_fabric(a);
  Json json = details_of(fabric);
  int code = exit_ok;
  if (!a.picture.empty()) {
    const io::SceneMaterial material = material_of_fabric(fabric.name);
    const DiscReport disc = jobs::drape_disc(disc_job(a, material), listener);
    json["disc"] = json_of(disc);
    draw_fabric(a, material, disc, json);
    code = exit_code_of(false, disc.rested > 0);
  }
  print_report(json, a);
  return code;
}

int drape_fabric(const FabricArguments& a, Listener& listener) {
  const io::Fabric& fabric = find_fabric(a);
  const DiscReport disc = jobs::drape_disc(disc_job(a, material_of_fabric(fabric.name)), listener);
  if (disc.rested < disc.starts)
    listener.warn(
        {"unrested",
         fmt::format("{} of {} starts did not come to rest", disc.starts - disc.rested, disc.starts),
         fabric.name, ""});
  Json json{{"fabric", fabric.name}, {"disc", json_of(disc)}};
  const double measured = fabric.threads.drape;
  json["measured"] = measured > 0 ? Json(measured) : Json(nullptr);
  if (!a.picture.empty()) {
    io::write_png(a.picture, panel_of(disc.mesh, "", 35).image);
    json["picture"] = a.picture;
  }
  std::vector<std::string> lines{
      fmt::format("{}: drape coefficient {:.3f} ({} folds; {:.3f} to {:.3f} over {} starts)", fabric.name,
                  disc.coefficient, disc.nodes, disc.least, disc.most, disc.starts)};
  if (measured > 0)
    lines.push_back(fmt::format("measured {:.3f}, off by {:+.3f}", measured, disc.coefficient - measured));
  print_report(json, a, {lines, {a.picture}});
  return exit_code_of(false, disc.rested > 0);
}

/// As a table of a scene.
std::string toml_of(const Json& material) {
  std::string text = "[material]\n";
  for (const auto& [key, value] : material.items())
    text +=
        key + " = " + (value.is_string() ? value.dump() : fmt::format("{:.6g}", value.get<double>())) + "\n";
  return text;
}

Json settings_of_material(const io::SceneMaterial& m) {
  Json json{{"density", m.density.value_or(0.15)}};
  if (!m.is_woven()) {
    json["stretch"] = m.stretch.value_or(1000), json["rigidity"] = m.rigidity;
    json["membrane"] = "triangles", json["bending_law"] = "hinge";
    return json;
  }
  json["warp_stretch"] = *m.warp_stretch, json["weft_stretch"] = *m.weft_stretch;
  json["thread_shear"] = *m.thread_shear, json["thread_poisson"] = m.thread_poisson;
  json["warp_rigidity"] = *m.warp_rigidity, json["weft_rigidity"] = *m.weft_rigidity;
  json["bias_rigidity"] = *m.bias_rigidity;
  json["membrane"] = "triangles", json["bending_law"] = "plate";
  return json;
}

int fit_fabric(const FabricArguments& a, Listener& listener) {
  const bool is_table = a.name.find('.') != std::string::npos;
  if (!is_table && !a.drape)
    throw UsageError(
        "fabric fit: name a table of KES or FAST figures (.toml), or a fabric and its measured "
        "drape coefficient: furrow fabric fit cotton --drape 0.55");
  Json settings = is_table ? jobs::fabric_from_table(io::read_toml(a.name))
                           : settings_of_material(material_of_fabric(find_fabric(a).name));
  Json json;
  if (a.drape) {
    const RigidityFit fit =
        jobs::fit_rigidity(disc_job(a, jobs::material_of_settings(settings)), *a.drape, listener);
    settings = settings_of_material(fit.material);
    json["factor"] = fit.factor, json["coefficient"] = fit.coefficient, json["measured"] = *a.drape;
  }
  json["material"] = settings;
  const std::string text = toml_of(settings);
  if (!a.out.empty() && a.out != "-") {
    io::write_atomically(a.out, [&](std::ostream& file) { file << text; });
    json["written"] = a.out;
  }
  print_report(json, a);
  return exit_ok;
}

int fabric(const FabricArguments& a) {
  catch_interrupts();
  Terminal terminal(a);
  check_picture(a.picture, "--picture");
  check_replaced({a.picture, a.out}, {a.name}, terminal);
  if (a.action == "show") return show(a, terminal);
  if (a.action == "drape") return drape_fabric(a, terminal);
  if (a.action == "fit") return fit_fabric(a, terminal);
  Json json{{"fabrics", Json::array()}};
  for (const io::Fabric& f : io::fabrics()) json["fabrics"].push_back(figures_of(f));
  print_report(json, a);
  return exit_ok;
}

}  // namespace

void add_fabric(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<FabricArguments>();
  CLI::App* sub =
      app.add_subcommand("fabric",
                         "List the fabrics, show one, drape a disc of it, or make one of measured figures\n\n"
                         "  furrow fabric list\n"
                         "  furrow fabric show black-denim --picture denim.png\n"
                         "  furrow fabric drape cotton-twill\n"
                         "  furrow fabric fit kes.toml -o mine.toml\n"
                         "  furrow fabric fit cotton --drape 0.55 -o mine.toml");
  sub->add_option("action", a->action, "list, show, drape or fit")
      ->required()
      ->check(CLI::IsMember({"list", "show", "drape", "fit"}));
  sub->add_option("name", a->name, "a fabric; fit: or a table of KES or FAST figures (.toml)");
  sub->add_option(
      "--picture", a->picture,
      "PNG to write: a draped disc; show: and swatches pulled at 0, 45 and 90 degrees to the warp");
  sub->add_option("--rings", a->rings,
                  "rings of the disc's mesh, a multiple of 5 from 10 to 100 (default 20)");
  sub->add_option("--drape", a->drape,
                  "fit: the measured drape coefficient of a 30 cm disc on 18 cm, in (0, 1): all rigidities "
                  "are scaled to it")
      ->check(CLI::Range(0.0, 1.0));
  sub->add_option("-o,--output", a->out, "fit: scene file to write, the settings of [material]");
  add_common_options(*sub, *a);
  sub->callback([a, &exit_code] { exit_code = fabric(*a); });
}

}  // namespace furrow::cli
