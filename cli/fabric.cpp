// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/fabric.h"

#include <fmt/format.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "io/base/atomic_file.h"
#include "io/base/nearest_word.h"
#include "io/base/number_text.h"
#include "io/picture/png_file.h"
#include "io/picture/render_scene.h"
#include "io/picture/render_weave.h"
#include "io/picture/strip.h"
#include "io/scene/fabrics.h"
#include "jobs/base/gate.h"

namespace furrow::cli {
namespace {

struct FabricArguments : CommonArguments {
  std::string action = "list", name, picture;
  int rings = 20;
  std::optional<double> drape;
  double bending_friction = 0;
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
  json["bending_friction"] = f.bending_friction > 0 ? Json(f.bending_friction) : Json(nullptr);
  json["source"] = f.source, json["assumed"] = f.assumed;
  return json;
}

std::string row_of(const io::Fabric& f) {
  const io::FabricThreads& t = f.threads;
  const auto bend = [](double b) { return fmt::format("{:.3g}", 1e6 * b); };
  const std::string stretch =
      t.any() ? fmt::format("{:.0f} / {:.0f}", t.warp, t.weft) : fmt::format("{:.0f}", f.stretch);
  const std::string bending =
      t.any() ? bend(t.bend_warp) + " / " + bend(t.bend_bias) + " / " + bend(t.bend_weft) : bend(f.rigidity);
  return fmt::format("{:<16} {:>5.0f}   {:<12}  {:<22}  {}", f.name, 1000 * f.density, stretch, bending,
                     t.drape > 0 ? fmt::format("{:.3f}", t.drape) : "");
}

std::string header_of_rows() {
  return fmt::format("{:<16} {:>5}   {:<12}  {:<22}  {}\n{:<16} {:>5}   {:<12}  {}", "fabric", "g/m^2",
                     "stretch N/m", "bending 1e-6 N m", "measured drape", "", "", "warp / weft",
                     "warp / bias / weft");
}

std::vector<std::string> lines_of(const io::Fabric& f) {
  const io::FabricThreads& t = f.threads;
  std::vector<std::string> lines{fmt::format("{}: {:.0f} g/m^2, {:.2g} mm thick, {}", f.name,
                                             1000 * f.density, 1000 * f.thickness,
                                             t.any() ? "with threads" : "the same in all directions")};
  if (t.any()) {
    lines.push_back(fmt::format("stretch: {:.0f} N/m along the warp, {:.0f} along the weft; shear {:.0f}",
                                t.warp, t.weft, t.shear));
    lines.push_back(
        fmt::format("bending: {:.3g} N m along the warp, {:.3g} on the bias, {:.3g} along the weft",
                    t.bend_warp, t.bend_bias, t.bend_weft));
  } else {
    lines.push_back(fmt::format("stretch: {:.0f} N/m; bending: {:.3g} N m", f.stretch, f.rigidity));
  }
  if (f.bending_friction > 0)
    lines.push_back(fmt::format("bending friction: a metre of crease bears {:.3g} N m before it gives way",
                                f.bending_friction));
  lines.push_back(fmt::format("measured: {}", f.source));
  lines.push_back(fmt::format("ours: {}", f.assumed));
  return lines;
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
  std::vector<std::string> names;
  for (const io::Fabric& f : io::fabrics()) names.emplace_back(f.name);
  throw UsageError("there is no fabric '" + a.name + "'; did you mean " + io::nearest_word(a.name, names) +
                   "? furrow fabric list has " + known_fabrics());
}

io::SceneMaterial material_of_fabric(const std::string& name) {
  return jobs::material_of_settings(Json{{"preset", name}});
}

io::Panel panel_of(const geometry::Mesh& mesh, const std::string& words, double azimuth, double elevation) {
  io::RenderScene scene;
  scene.meshes.push_back(io::render_mesh_from(mesh));
  scene.lines = io::weave_lines_from(mesh, io::weave_spacing(mesh) * 1.6);
  io::RenderOptions options;
  options.width = options.height = 480;
  options.view.azimuth_deg = azimuth;
  options.view.elevation_deg = elevation;
  return {io::render(scene, options), words};
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
  job.bending_friction = a.bending_friction;
  return job;
}

DiscReport drape(const FabricArguments& a, const std::string& name, Listener& listener) {
  DiscReport disc = jobs::drape_disc(disc_job(a, material_of_fabric(name)), listener);
  if (disc.rested < disc.starts)
    listener.warn({"unrested",
                   fmt::format("{}: {} of {} starts did not come to rest; they do not count", name,
                               disc.starts - disc.rested, disc.starts),
                   name, ""});
  return disc;
}

std::string words_of_disc(const DiscReport& disc) {
  return fmt::format("drape coefficient {:.3f} ({} folds; {:.3f} to {:.3f} over {} starts)", disc.coefficient,
                     disc.nodes, disc.least, disc.most, disc.starts);
}

/// Swatches pulled by 10 % at 0, 45 and 90 degrees to the warp, each beside those before it.
Json pull_swatches(const io::SceneMaterial& material, std::vector<io::Panel>& panels) {
  Json swatches = Json::array();
  for (const double angle : {0., 45., 90.}) {
    const SwatchReport s = jobs::pull_swatch(material, angle, 0.1);
    swatches.push_back({{"angle", angle},
                        {"strain", 0.1},
                        {"force", s.force},
                        {"modulus", s.modulus},
                        {"modulus_of_long_strip", s.wanted},
                        {"rested", s.rested}});
    panels.push_back(panel_of(s.mesh, fmt::format("{:.0f} degrees: {:.3g} N/m", angle, s.force), 0, 85));
  }
  return swatches;
}

int show(const FabricArguments& a, Listener& listener) {
  const io::Fabric& fabric = find_fabric(a);
  Json json = details_of(fabric);
  std::vector<std::string> lines = lines_of(fabric);
  bool rested = true;
  if (!a.picture.empty()) {
    const DiscReport disc = drape(a, fabric.name, listener);
    std::vector<io::Panel> panels{
        panel_of(disc.mesh, fmt::format("drape coefficient {:.2f}", disc.coefficient), 30, 35)};
    json["disc"] = json_of(disc);
    json["swatches"] = pull_swatches(material_of_fabric(fabric.name), panels);
    io::write_png(a.picture, io::strip(panels));
    rested = disc.rested > 0;
    lines.push_back(words_of_disc(disc));
  }
  json["written"] = names_of_files({a.picture});
  print_report(json, a,
               {lines,
                {a.picture},
                {"furrow", "drape", "GARMENT", "--body", "BODY", "--fabric", a.name, "-o", "worn.ply"}});
  return exit_code_of(false, rested);
}

int drape_fabric(const FabricArguments& a, Listener& listener) {
  const io::Fabric& fabric = find_fabric(a);
  const DiscReport disc = drape(a, fabric.name, listener);
  const double measured = fabric.threads.drape;
  const Json json{{"fabric", fabric.name},
                  {"disc", json_of(disc)},
                  {"measured", measured > 0 ? Json(measured) : Json(nullptr)},
                  {"written", names_of_files({a.picture})}};
  if (!a.picture.empty()) io::write_png(a.picture, panel_of(disc.mesh, "", 30, 35).image);
  std::vector<std::string> lines{a.name + ": " + words_of_disc(disc)};
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
  Json json{{"density", m.density.value()}};
  if (!m.is_woven()) {
    json["stretch"] = m.stretch.value(), json["rigidity"] = m.rigidity;
    json["membrane"] = "triangles", json["bending_law"] = "plate";
    return json;
  }
  json["warp_stretch"] = *m.warp_stretch, json["weft_stretch"] = *m.weft_stretch;
  json["thread_shear"] = *m.thread_shear, json["thread_poisson"] = m.thread_poisson;
  json["warp_rigidity"] = *m.warp_rigidity, json["weft_rigidity"] = *m.weft_rigidity;
  json["bias_rigidity"] = *m.bias_rigidity;
  json["membrane"] = "triangles", json["bending_law"] = "plate";
  return json;
}

bool is_table(const std::string& name) { return name.find('.') != std::string::npos; }

/// Of a table, of a fabric and a measured drape coefficient, or of a table and such.
Json fitted(const FabricArguments& a, Listener& listener) {
  if (!is_table(a.name) && !a.drape)
    throw UsageError(
        "fabric fit: name a table of KES or FAST figures (.toml), or a fabric and its measured "
        "drape coefficient: furrow fabric fit cotton --drape 0.55");
  Json json{{"material", is_table(a.name) ? jobs::fabric_from_table(io::read_toml(a.name))
                                          : settings_of_material(material_of_fabric(find_fabric(a).name))}};
  if (!a.drape) return json;
  const RigidityFit fit =
      jobs::fit_rigidity(disc_job(a, jobs::material_of_settings(json["material"])), *a.drape, listener);
  if (std::abs(fit.coefficient - *a.drape) > 0.01)
    listener.warn(
        {"drape_missed",
         fmt::format("the disc drapes {:.3f} at the best factor, not {:.3f}: it takes another number of "
                     "folds there",
                     fit.coefficient, *a.drape),
         a.name, ""});
  json["material"] = settings_of_material(fit.material);
  json["factor"] = fit.factor, json["coefficient"] = fit.coefficient, json["measured"] = *a.drape;
  return json;
}

/// A scene's [material], and how it was found.
std::string file_of(const FabricArguments& a, const Json& fitted) {
  const std::string how =
      a.drape
          ? fmt::format("# {}, its rigidities times {:.3g}: a disc drapes {:.3f}, measured {:.3f}\n", a.name,
                        fitted["factor"].get<double>(), fitted["coefficient"].get<double>(), *a.drape)
          : fmt::format("# {}\n", a.name);
  return io::one_line(how.substr(0, how.size() - 1)) + "\n" + toml_of(fitted["material"]);
}

/// Without a file to write, the settings themselves are what is printed.
int fit_fabric(const FabricArguments& a, Listener& listener) {
  Json json = fitted(a, listener);
  const std::string text = file_of(a, json);
  if (a.out == "-" || a.out.empty()) {
    json["written"] = Json::array();
    print_report(json, a, {{text.substr(0, text.size() - 1)}});
    return exit_ok;
  }
  io::write_atomically(a.out, [&](std::ostream& file) { file << text; });
  json["written"] = names_of_files({a.out});
  print_report(json, a,
               {{text.substr(2, text.find('\n') - 2)},
                {a.out},
                {"furrow", "drape", "GARMENT", "--body", "BODY", "--fabric", a.out, "-o", "worn.ply"}});
  return exit_ok;
}

int list(const FabricArguments& a) {
  Json json{{"fabrics", Json::array()}};
  std::string rows = header_of_rows();
  for (const io::Fabric& f : io::fabrics())
    json["fabrics"].push_back(figures_of(f)), rows += "\n" + row_of(f);
  print_report(json, a, {{rows}, {}, {"furrow", "fabric", "show", "NAME", "--picture", "fabric.png"}});
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
  return list(a);
}

int run_fabric(FabricArguments& a) {
  if (a.out == "-") a.out.clear();  // which is standard output, too
  return fabric(a);
}

void add_fabric(CLI::App& sub, FabricArguments& a) {
  sub.add_option("action", a.action, "list (the default), show, drape or fit")
      ->check(CLI::IsMember({"list", "show", "drape", "fit"}));
  sub.add_option("name", a.name, "a fabric; fit: or a table of KES or FAST figures (.toml)");
  sub.add_option(
      "--picture", a.picture,
      "PNG to write: a draped disc; show: and swatches pulled at 0, 45 and 90 degrees to the warp");
  sub.add_option("--rings", a.rings, "rings of the disc's mesh, a multiple of 5 from 10 to 100 (default 20)");
  sub.add_option("--drape", a.drape,
                 "fit: the measured drape coefficient of a 30 cm disc on 18 cm, in (0, 1): all rigidities "
                 "are scaled to it")
      ->check(CLI::Range(0.0, 1.0));
  sub.add_option("--bending-friction", a.bending_friction,
                 "drape, and the disc of show: the moment that a metre of crease bears before it gives way "
                 "[N] (default 0; half of Kawabata's 2HB)")
      ->check(CLI::NonNegativeNumber);
  sub.add_option("-o,--output", a.out, "fit: file to write, for --fabric; default: it is printed");
}

const Subcommand fabric_subcommand(
    140, "fabric",
    "List the fabrics, show one, drape a disc of it, or make one of measured figures\n\n"
    "  furrow fabric list\n"
    "  furrow fabric show black-denim --picture denim.png\n"
    "  furrow fabric drape cotton-twill\n"
    "  furrow fabric fit kes.toml -o mine.toml\n"
    "  furrow fabric fit cotton --drape 0.55 -o mine.toml\n"
    "  furrow drape shirt.obj --body body.obj --fabric mine.toml -o worn.ply",
    add_fabric, run_fabric);

}  // namespace
}  // namespace furrow::cli
