// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <sstream>

#include "bridge/fit_report.h"
#include "cli/body.h"
#include "cli/camera_options.h"
#include "cli/common.h"
#include "cli/fit_output.h"
#include "cli/output_checks.h"
#include "cli/subcommands.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"

namespace furrow::cli {
namespace {

struct FitArguments : CommonArguments {
  std::vector<std::string> worn, bodies, sections;
  std::string rest, picture, colour, captions;
  std::optional<double> range, contact;
  bridge::FitOptions options;
  CameraArguments camera;
  bool compare = false, view_chosen = false;
};

/// "chest=1.25" and the like.
void take_sections(FitArguments& a) {
  for (const std::string& text : a.sections) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    bridge::SectionHeights& heights = a.options.sections;
    std::optional<double>* height = name == "chest"   ? &heights.chest
                                    : name == "waist" ? &heights.waist
                                    : name == "hip"   ? &heights.hip
                                                      : nullptr;
    if (!height || equals == std::string::npos)
      throw UsageError("--section takes chest=, waist= or hip= and a height [m], not '" + text + "'");
    *height = parse_numbers(text.substr(equals + 1), 1, "--section " + name)[0];
  }
}

std::vector<std::string> parts_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> parts;
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

void check_call(const FitArguments& a) {
  if (a.worn.size() > 1 && !a.compare)
    throw UsageError(std::to_string(a.worn.size()) + " garments: say --compare to lay them side by side");
  if (a.bodies.size() > 1 && a.bodies.size() != a.worn.size())
    throw UsageError("--body: " + std::to_string(a.bodies.size()) + " bodies for " +
                     std::to_string(a.worn.size()) + " garments; give one, or one for each");
  if (!a.out.empty() && a.worn.size() > 1) throw UsageError("-o writes one garment, not those of --compare");
  if (!a.rest.empty() && a.worn.size() > 1) throw UsageError("--rest is that of one garment");
  if (a.picture.empty() && (a.view_chosen || !a.captions.empty() || !a.camera.save_camera.empty()))
    throw UsageError("a view, --captions and --save-camera are of use with --picture only");
  if (parts_of(a.captions).size() > a.worn.size())
    throw UsageError("--captions: " + std::to_string(parts_of(a.captions).size()) + " for " +
                     std::to_string(a.worn.size()) + " garments");
  if (a.range && !(*a.range > 0 && std::isfinite(*a.range)))
    throw UsageError("--range takes a number > 0, not " + Json(*a.range).dump());
  if (!a.out.empty()) check_output(a.out);
  check_picture(a.picture, "--picture");
  check_folder(a.camera.save_camera);
  std::vector<std::string> inputs = a.worn;
  inputs.insert(inputs.end(), a.bodies.begin(), a.bodies.end());
  inputs.insert(inputs.end(), {a.rest, a.camera.camera});
  refuse_same({a.out, a.picture, a.camera.save_camera}, inputs);
}

/// Rest lengths as the edges are long in a mesh with the same vertices.
void take_rest(geometry::Mesh& mesh, const FitArguments& a) {
  const io::MeshFile rest = read_mesh(a.rest, a);
  if (rest.mesh.num_vertices() != mesh.num_vertices())
    throw geometry::ContentError(a.rest + ": has " + std::to_string(rest.mesh.num_vertices()) +
                                 " vertices, but " + a.worn[0] + " has " +
                                 std::to_string(mesh.num_vertices()));
  auto lengths = geometry::ensure_map(mesh, geometry::attribute::rest_length);
  for (geometry::Edge e : mesh.edges())
    lengths[e] = std::sqrt(
        CGAL::squared_distance(rest.mesh.point(mesh.vertex(e, 0)), rest.mesh.point(mesh.vertex(e, 1))));
}

struct Body {
  physics::TriangleMesh triangles;
  physics::ExactDistance distance;
};

struct Fitted {
  std::string name;
  io::MeshFile file;
  bridge::FitReport report;
  bridge::FitOptions options;
  std::string caption;
};

Fitted fit_one(const std::string& path, const Body& body, const FitArguments& a) {
  Fitted fitted{std::filesystem::path(path).stem().string(), read_garment(path, a), {}, a.options, {}};
  geometry::Mesh& mesh = fitted.file.mesh;
  if (!a.rest.empty()) take_rest(mesh, a);
  if (mesh.number_of_edges() > 0)
    fitted.options.contact_distance = a.contact ? *a.contact : contact_distance(fitted.file, body.distance);
  fitted.report = bridge::fit_report(mesh, body.triangles, body.distance, fitted.options);
  if (!fitted.report.strain)
    warn(path + ": has no rest lengths, so its strain is not known; --rest takes the garment as it was made" +
             (a.compare ? " (a second body needs a --body of its own)" : ""),
         a);
  if (fitted.report.ease.empty())
    warn("no chest, waist and hips were found on the body; --section chest=1.25 tells their heights", a);
  return fitted;
}

/// The quantity that is asked for, or strain where all garments know theirs.
io::FitQuantity quantity(const std::vector<Fitted>& all, const FitArguments& a) {
  const auto without = std::find_if(all.begin(), all.end(), [](const Fitted& f) { return !f.report.strain; });
  if (a.colour == "strain" && without != all.end())
    throw geometry::ContentError(without->name +
                                 ": has no rest lengths, so no strain can be shown; give --rest, or --colour "
                                 "distance");
  if (a.colour == "distance" || without != all.end()) return io::FitQuantity::distance;
  return io::FitQuantity::strain;
}

void set_captions(std::vector<Fitted>& all, io::FitQuantity shown, const FitArguments& a) {
  const std::vector<std::string> given = parts_of(a.captions);
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i].caption = (i < given.size() ? given[i] : all[i].name) + (all.size() > 1 ? "\n" : ": ") +
                     fit_words(all[i].report, a.options, shown);
}

void write_picture(const std::vector<Fitted>& all, const io::FitScale& scale, const FitArguments& a) {
  std::vector<geometry::Mesh> bodies;
  for (const std::string& path : a.bodies) bodies.push_back(io::read_mesh(path, read_options(a)).mesh);
  std::vector<FitPanel> panels;
  for (std::size_t i = 0; i < all.size(); ++i)
    panels.push_back({&all[i].file.mesh, &bodies[bodies.size() > 1 ? i : 0], all[i].caption});
  io::write_png(a.picture, fit_picture(panels, scale, a.camera, a.view_chosen, a));
}

Json report_of(const std::vector<Fitted>& all, const FitArguments& a) {
  Json report;
  if (all.size() == 1) {
    report = to_json(all[0].report, all[0].options);
  } else {
    Json garments = Json::array();
    for (std::size_t i = 0; i < all.size(); ++i) {
      garments.push_back({{"garment", a.worn[i]}});
      garments.back().update(to_json(all[i].report, all[i].options));
    }
    report = {{"garments", garments}};
  }
  if (!a.picture.empty()) report["picture"] = a.picture;
  if (!a.out.empty()) report["written"] = a.out;
  return report;
}

void fit(FitArguments a) {
  take_sections(a);
  check_call(a);
  take_noted_frame(a, a.worn);
  std::vector<Body> bodies;
  for (const std::string& path : a.bodies) {
    physics::TriangleMesh triangles = read_body(path, a);
    physics::ExactDistance distance(triangles);
    bodies.push_back({std::move(triangles), std::move(distance)});
  }
  std::vector<Fitted> all;
  for (std::size_t i = 0; i < a.worn.size(); ++i)
    all.push_back(fit_one(a.worn[i], bodies[bodies.size() > 1 ? i : 0], a));
  const io::FitScale scale = fit_scale(quantity(all, a), a.options, a.range);
  set_captions(all, scale.quantity, a);
  for (Fitted& fitted : all) colour_garment(fitted.file.mesh, scale);
  if (!a.picture.empty()) write_picture(all, scale, a);
  if (!a.out.empty()) write_mesh(all[0].file, a);
  print_report(report_of(all, a), a);
}

void add_thresholds(CLI::App& sub, FitArguments& a) {
  sub.add_option("--tight", a.options.tight_strain, "cloth strained more is tight [-], > 0")
      ->capture_default_str();
  sub.add_option("--loose", a.options.loose_distance, "cloth farther from the body is loose [m], > 0")
      ->capture_default_str();
  sub.add_option(
      "--contact", a.contact,
      "cloth nearer lies on the body [m], >= 0; default 1.2 times the gap that the garment kept, or "
      "would keep");
  sub.add_option("--smallest-zone", a.options.smallest_zone, "zones with less area are left out [m^2], >= 0")
      ->capture_default_str();
  sub.add_option(
         "--section", a.sections,
         "height of a section in place of what is found on the body, e.g. chest=1.25; chest, waist or "
         "hip [m]; may be given again")
      ->allow_extra_args(false);
}

}  // namespace

void add_fit(CLI::App& app) {
  auto a = std::make_shared<FitArguments>();
  a->camera.size = "900,1100";
  CLI::App* sub = app.add_subcommand(
      "fit",
      "Tell how a worn garment fits: where it is tight, where it is loose, how much room there is\n\n"
      "  furrow fit worn.ply --body body.obj --picture fit.png\n"
      "  furrow fit worn.ply --body body.obj --colour distance --picture room.png -o coloured.ply\n"
      "  furrow fit --compare S.ply M.ply L.ply --body body.obj --picture sizes.png");
  sub->add_option("worn", a->worn, "a garment as it is worn: what simulate or drape wrote")->required();
  sub->add_option("--body", a->bodies,
                  "the body that wears it, as it stands there; with --compare one, or one for each garment: "
                  "--body A.obj --body B.obj")
      ->required()
      ->allow_extra_args(false);
  sub->add_option(
      "--rest", a->rest,
      "the garment as it was made, with the same vertices, where the worn one has no rest lengths");
  sub->add_flag("--compare", a->compare, "several garments side by side, with one scale");
  sub->add_option("--picture", a->picture, "PNG to write: coloured cloth on the body, with a legend");
  sub->add_option("-o,--output", a->out,
                  "mesh to write with colours; PLY keeps the columns fit_distance [m] "
                  "and strain [-], too");
  sub->add_option("--colour", a->colour, "strain or distance; default strain, where it is known")
      ->check(CLI::IsMember({"strain", "distance"}));
  sub->add_option("--range", a->range,
                  "where the colours end: strain [-] or distance [m]; default 2 x --tight, 1.2 x --loose");
  sub->add_option("--captions", a->captions, "words for the pictures, parted by commas; default: file names");
  add_thresholds(*sub, *a);
  add_camera_options(*sub, a->camera);
  add_common_options(*sub, *a);
  sub->callback([a, sub] {
    for (const char* option : {"--view", "--camera", "--eye", "--target"})
      a->view_chosen = a->view_chosen || sub->count(option) > 0;
    fit(*a);
  });
}

}  // namespace furrow::cli
