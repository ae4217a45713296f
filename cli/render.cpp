// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/render.h"

#include <cmath>
#include <map>
#include <memory>
#include <sstream>
#include <thread>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "io/checker_texture.h"
#include "io/render_scene.h"
#include "io/strip.h"
#include "io/stroke_file.h"
#include "io/wrinkle_record.h"

namespace furrow::cli {
namespace {

struct RenderArguments : CommonArguments {
  std::vector<std::string> meshes;
  std::string texture, body, strokes, size = "1200,1200", view = "three-quarter", eye, target, captions,
                                      quality = "normal";
  double field_of_view = io::View{}.field_of_view_deg;
  bool strip = false, no_lines = false;
};

/// Azimuth and elevation [degrees] of the named views.
const std::map<std::string, std::pair<double, double>> kViews{{"three-quarter", {25, 8}}, {"front", {0, 0}},
                                                              {"back", {180, 0}},         {"left", {90, 0}},
                                                              {"right", {-90, 0}},        {"top", {0, 85}}};
const std::map<std::string, io::Quality> kQualities{
    {"draft", io::Quality::draft}, {"normal", io::Quality::normal}, {"fine", io::Quality::fine}};

io::Position position(const std::string& text, const std::string& option) {
  const std::vector<double> x = parse_numbers(text, 3, option);
  return {x[0], x[1], x[2]};
}

std::shared_ptr<const io::Image> read_texture(const std::string& name) {
  if (name.empty()) return nullptr;
  return std::make_shared<io::Image>(name == "checker" ? io::checker_texture() : io::read_png(name));
}

void add_garment(io::RenderScene& scene, const std::string& path,
                 const std::shared_ptr<const io::Image>& texture, const RenderArguments& a) {
  const io::MeshFile file = read_mesh(path, a);
  scene.meshes.push_back(io::render_mesh_from(file.mesh, io::Style::cloth, texture));
  if (a.no_lines) return;
  std::vector<double> heights;
  if (const auto record = io::find_wrinkle_record(file))
    for (const auto& line : record->lines) heights.push_back(line.height);
  for (io::RenderLine& line : io::render_lines_from(file.mesh, heights))
    scene.lines.push_back(std::move(line));
}

/// One scene with all meshes, or for a strip one a mesh (the strokes are drawn on its first); the body stands
/// in each.
std::vector<io::RenderScene> scenes(const RenderArguments& a) {
  std::vector<io::RenderScene> list(a.strip ? a.meshes.size() : 1);
  const auto texture = read_texture(a.texture);
  for (std::size_t i = 0; i < a.meshes.size(); ++i)
    add_garment(list[a.strip ? i : 0], a.meshes[i], texture, a);
  if (!a.body.empty()) {
    io::RenderMesh body = io::render_mesh_from(read_mesh(a.body, a).mesh, io::Style::body);
    body.colour = io::kBodyColour;
    body.framed = false;
    for (io::RenderScene& scene : list) scene.meshes.push_back(body);
  }
  if (!a.strokes.empty())
    for (io::RenderLine& line : io::render_lines_from(io::read_strokes(a.strokes, 0.01, read_options(a))))
      list[0].lines.push_back(std::move(line));
  return list;
}

io::RenderOptions to_options(const RenderArguments& a) {
  io::RenderOptions o;
  const std::vector<double> size = parse_numbers(a.size, 2, "--size");
  for (double side : size)
    if (!(side >= 1 && side <= 16384) || side != std::floor(side))
      throw UsageError("--size takes two whole numbers from 1 to 16384, not '" + a.size + "'");
  o.width = static_cast<int>(size[0]);
  o.height = static_cast<int>(size[1]);
  o.quality = kQualities.at(a.quality);
  o.view.azimuth_deg = kViews.at(a.view).first;
  o.view.elevation_deg = kViews.at(a.view).second;
  o.view.field_of_view_deg = a.field_of_view;
  o.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return o;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

void render(const RenderArguments& a) {
  if (a.out == "-") throw UsageError("-o: a picture needs a file name");
  for (const std::string& mesh : a.meshes) refuse_same(a.out, mesh);
  if (a.eye.empty() != a.target.empty()) throw UsageError("--eye and --target go together");
  const std::vector<io::RenderScene> list = scenes(a);
  io::RenderOptions options = to_options(a);
  options.camera = io::automatic_camera(list, options);
  if (!a.eye.empty())
    options.camera =
        io::Camera{position(a.eye, "--eye"), position(a.target, "--target"), {0, 1, 0}, a.field_of_view};
  const std::vector<std::string> captions = split(a.captions);
  std::vector<io::Panel> panels;
  Progress progress("rendering", a);
  for (std::size_t i = 0; i < list.size(); ++i) {
    panels.push_back({io::render(list[i], options), i < captions.size() ? captions[i] : ""});
    progress.show(double(i + 1) / double(list.size()));
  }
  const io::Image image = a.strip ? io::strip(panels) : panels[0].image;
  io::write_png(a.out, image);
  print_report({{"width", image.width}, {"height", image.height}, {"written", a.out}}, a);
}

void add_camera_options(CLI::App& sub, RenderArguments& a) {
  sub.add_option("--view", a.view, "from where: front, back, left, right, top or three-quarter")
      ->check(CLI::IsMember(kViews))
      ->capture_default_str();
  sub.add_option("--eye", a.eye,
                 "where the camera stands: x,y,z [m, y up]; with --target, in place of --view");
  sub.add_option("--target", a.target, "what it looks at: x,y,z [m, y up]");
  sub.add_option("--fov", a.field_of_view, "vertical opening of the camera [degrees]")->capture_default_str();
}

}  // namespace

void add_render(CLI::App& app) {
  auto a = std::make_shared<RenderArguments>();
  CLI::App* sub = app.add_subcommand(
      "render",
      "Make a picture of meshes, without a display\n\n"
      "  furrow render worn.ply --body body.obj -o worn.png\n"
      "  furrow render --strip a.obj b.ply c.ply --captions drawn,smoothed,hung -o strip.png");
  sub->add_option("meshes", a->meshes, "garments to show; ridges are red, valleys blue")->required();
  sub->add_option("-o,--output", a->out, "PNG to write")->required();
  sub->add_option("--texture", a->texture, "PNG to lay on the garments, or checker: numbered squares");
  sub->add_option("--body", a->body, "a body to show with them");
  sub->add_option("--strokes", a->strokes, "strokes to draw on the first garment");
  sub->add_flag("--no-lines", a->no_lines, "leave out the lines that the garments carry");
  sub->add_flag("--strip", a->strip, "one picture a garment, side by side from the same camera");
  sub->add_option("--captions", a->captions, "words under the pictures of a strip, parted by commas");
  sub->add_option("--size", a->size, "width,height of each picture [pixels]")->capture_default_str();
  sub->add_option("--quality", a->quality, "draft, normal or fine")
      ->check(CLI::IsMember(kQualities))
      ->capture_default_str();
  add_camera_options(*sub, *a);
  add_common_options(*sub, *a);
  sub->callback([a] { render(*a); });
}

}  // namespace furrow::cli
