// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render.h"

#include <Eigen/Geometry>
#include <memory>

#include "cli/camera_options.h"
#include "cli/common.h"
#include "cli/subcommands.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "io/base/atomic_file.h"
#include "io/mesh/mesh_file.h"
#include "io/picture/checker_texture.h"
#include "io/picture/render_scene.h"
#include "io/picture/render_weave.h"
#include "io/picture/strip.h"
#include "io/stroke/resolve_strokes.h"
#include "io/stroke/stroke_file.h"
#include "jobs/base/gate.h"
#include "jobs/base/measure_crossings.h"
#include "jobs/base/read_inputs.h"
#include "jobs/cloth/lay_warp.h"

namespace furrow::cli {
namespace {

struct RenderArguments : CommonArguments {
  std::vector<std::string> meshes;
  std::vector<std::string> bodies, strokes;
  std::string texture, captions, colour, warp = "auto";
  CameraArguments camera;
  bool strip = false, no_lines = false, figure = false, weave = false;
};

std::shared_ptr<const io::Image> read_texture(const std::string& name) {
  if (name.empty()) return nullptr;
  return std::make_shared<io::Image>(name == "checker" ? io::checker_texture() : io::read_png(name));
}

/// A colour as in HTML: #rrggbb. Throws UsageError.
io::Colour parse_colour(const std::string& text) {
  const std::size_t first = text.starts_with('#') ? 1 : 0;
  if (text.size() != first + 6 ||
      text.find_first_not_of("0123456789abcdefABCDEF", first) != std::string::npos)
    throw UsageError("--colour takes a colour as #rrggbb, such as #b03a48, not '" + text + "'");
  io::Colour colour;
  for (std::size_t k = 0; k < 3; ++k)
    colour[k] = float(std::stoi(text.substr(first + 2 * k, 2), nullptr, 16)) / 255;
  return colour;
}

/// Faces of the cloth that cross are magenta, as in the pictures of drape; counts the pairs.
void mark_crossings(io::RenderMesh& shown, const io::MeshFile& file, const std::string& path,
                    std::size_t& pairs, const RenderArguments& a) {
  try {
    const ClothCrossings found = measure_crossings(file);
    io::mark_faces(shown, found.faces);
    pairs += found.pairs;
  } catch (const geometry::ContentError& e) {  // a picture may be just what tells why
    warn(path + ": faces that cross are not marked: " + e.what(), a);
  }
}

/// A camera counts in metres, too: strokes drawn in its picture would miss the garment in another unit.
void warn_of_unit(const io::MeshFile& file, const std::string& path, const RenderArguments& a) {
  if (a.camera.save_camera.empty() && a.camera.camera.empty() && a.camera.eye.empty()) return;
  if (const std::string odd = odd_size(file.mesh, "garment", a); !odd.empty())
    warn(path + ": " + odd + "; the camera is of that unit, and strokes drawn in its picture with it", a);
}

/// Where the threads run, as a job would take it.
void add_weave(io::RenderScene& scene, const std::string& path, const RenderArguments& a) {
  io::MeshFile file = read_mesh(path, a);
  Terminal terminal(a);
  jobs::lay_warp(file, a.warp, true, path, {a, terminal});
  for (io::RenderLine& line : io::weave_lines_from(file.mesh, io::weave_spacing(file.mesh)))
    scene.lines.push_back(std::move(line));
}

void add_garment(io::RenderScene& scene, const std::string& path,
                 const std::shared_ptr<const io::Image>& texture, std::size_t& crossings,
                 const RenderArguments& a) {
  const io::MeshFile file = read_mesh(path, a);
  warn_of_unit(file, path, a);
  if (texture && !geometry::find_map(file.mesh, geometry::attribute::texture))
    throw geometry::ContentError(path + ": has no texture coordinates to lay --texture on with");
  scene.meshes.push_back(io::render_mesh_from(file.mesh, io::Style::cloth, texture));
  if (!a.colour.empty()) {
    scene.meshes.back().colour = parse_colour(a.colour);
    scene.meshes.back().vertex_colours.clear();
  }
  mark_crossings(scene.meshes.back(), file, path, crossings, a);
  if (a.weave) add_weave(scene, path, a);
  if (a.no_lines) return;
  std::vector<double> heights;
  if (const auto record = io::find_wrinkle_record(file))
    for (const auto& line : record->lines) heights.push_back(line.height);
  for (io::RenderLine& line : io::render_lines_from(file.mesh, heights))
    scene.lines.push_back(std::move(line));
}

/// Throws geometry::ContentError, naming the first file, where nothing is to be seen: all lies at one point.
void require_extent(const io::RenderScene& scene, const std::string& path) {
  Eigen::AlignedBox3d box;
  for (const io::RenderMesh& mesh : scene.meshes)
    for (const auto& triangle : mesh.triangles)
      for (const int v : triangle) {
        const auto& p = mesh.vertices[std::size_t(v)];
        box.extend(Eigen::Vector3d(p[0], p[1], p[2]));
      }
  if (!box.isEmpty() && !(box.diagonal().norm() > 1e-9))
    throw geometry::ContentError(path + ": all its vertices lie at one point, so there is nothing to see");
}

/// The strokes of a file as they lie on the first garment.
void add_strokes(io::RenderScene& scene, const std::string& strokes, const RenderArguments& a) {
  const io::MeshFile garment = read_mesh(a.meshes[0], a);
  const auto drawn = io::read_drawn_strokes(strokes, geometry::Stroke{}.height, read_options(a));
  io::ResolvedStrokes resolved = io::resolve_strokes(drawn, garment);
  for (io::RenderLine& line : io::render_lines_from(garment.mesh, resolved.strokes, resolved.warnings))
    scene.lines.push_back(std::move(line));
  for (const std::string& w : resolved.warnings) warn(w, a);
}

/// Bodies stand in each scene, or one in each if there are as many.
void add_bodies(std::vector<io::RenderScene>& scenes, const RenderArguments& a) {
  const bool one_each = scenes.size() > 1 && a.bodies.size() == scenes.size();
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    io::RenderMesh body = io::render_mesh_from(read_mesh(a.bodies[i], a).mesh, io::Style::body);
    body.colour = io::body_colour;
    body.framed = a.figure;
    for (std::size_t k = 0; k < scenes.size(); ++k)
      if (!one_each || k == i) scenes[k].meshes.push_back(body);
  }
}

/// One scene with all meshes, or for a strip one a mesh (the strokes are drawn on its first). Counts the
/// pairs of faces that cross.
std::vector<io::RenderScene> scenes(const RenderArguments& a, std::size_t& crossings) {
  std::vector<io::RenderScene> list(a.strip ? a.meshes.size() : 1);
  const auto texture = read_texture(a.texture);
  for (std::size_t i = 0; i < a.meshes.size(); ++i)
    add_garment(list[a.strip ? i : 0], a.meshes[i], texture, crossings, a);
  for (std::size_t i = 0; i < list.size(); ++i) require_extent(list[i], a.meshes[i]);
  add_bodies(list, a);
  for (const std::string& strokes : a.strokes) add_strokes(list[0], strokes, a);
  return list;
}

/// What can be known to fail is said before the work.
void check_call(const RenderArguments& a) {
  check_picture(a.out, "-o");
  check_folder(a.camera.save_camera);
  std::vector<std::string> inputs = a.meshes;
  inputs.insert(inputs.end(), a.bodies.begin(), a.bodies.end());
  inputs.insert(inputs.end(), a.strokes.begin(), a.strokes.end());
  inputs.insert(inputs.end(), {a.texture, a.camera.camera});
  Terminal terminal(a);
  check_replaced({a.out, a.camera.save_camera}, inputs, terminal);
  if (!a.colour.empty()) parse_colour(a.colour);
  if (a.figure && a.bodies.empty()) throw UsageError("--figure shows the whole of a --body: name one");
  if (a.warp != "auto" && !a.weave) throw UsageError("--warp is shown with --weave: add it");
  if (!a.captions.empty() && !a.strip) throw UsageError("--captions stand under the pictures of a --strip");
}

Lines render_lines(const Json& report) {
  Lines lines{"picture of " + std::to_string(count_of(report, "width")) + " x " +
              std::to_string(count_of(report, "height")) + " pixels"};
  if (const long long n = count_of(report, "crossing_pairs"))
    lines.push_back("look at: " + counted(n, "pair") + " of faces cross, in magenta");
  return lines;
}

void render(RenderArguments a) {
  check_call(a);
  take_noted_frame(a, a.meshes);
  std::size_t crossings = 0;
  const std::vector<io::RenderScene> list = scenes(a, crossings);
  const io::RenderOptions options = render_options(list, a.camera);
  const std::vector<std::string> captions = split_at_commas(a.captions);
  if (captions.size() > list.size())
    throw UsageError("--captions: " + std::to_string(captions.size()) + " for " +
                     std::to_string(list.size()) + " pictures");
  std::vector<io::Panel> panels;
  Progress progress("rendering", a, unlimited);
  for (std::size_t i = 0; i < list.size(); ++i) {
    panels.push_back({io::render(list[i], options), i < captions.size() ? captions[i] : ""});
    progress.show(double(i + 1) / double(list.size()));
  }
  const io::Image image = a.strip ? io::strip(panels) : panels[0].image;
  io::OutputGroup together;
  io::write_png(a.out, image);
  const Json camera = save_camera(options, a.camera);
  together.commit();
  const Json json{{"width", image.width},
                  {"height", image.height},
                  {"camera", camera},
                  {"crossing_pairs", crossings},
                  {"written", a.out}};
  print_report(json, a, {render_lines(json), {a.out, a.camera.save_camera}});
}

void add_render(CLI::App& sub, RenderArguments& a) {
  sub.add_option("meshes", a.meshes,
                 "garments to show; ridges are red, valleys blue, faces that cross magenta")
      ->required();
  sub.add_option("-o,--output", a.out, "PNG to write")->required();
  sub.add_option("--texture", a.texture, "PNG to lay on the garments, or checker: numbered squares");
  sub.add_option("--colour", a.colour,
                 "of the garments, as #rrggbb, in place of their own; --texture goes before it");
  sub.add_option("--body", a.bodies,
                 "a body to show with them; may be given again: in a strip with as many, one a picture")
      ->allow_extra_args(false);
  sub.add_flag("--figure", a.figure, "the whole body is in the picture, not the garment alone");
  sub.add_option("--strokes", a.strokes, "strokes to draw on the first garment; may be given again")
      ->allow_extra_args(false);
  sub.add_flag(
      "--weave", a.weave,
      "the threads of the garments: a long red stroke along the warp, a short blue one along the weft");
  sub.add_option("--warp", a.warp,
                 "with --weave, where the warp runs: file, texture, texture-u, x, y, z or a stroke file "
                 "(default: the map in its PLY, else texture, else upwards)");
  sub.add_flag("--no-lines", a.no_lines, "leave out the lines that the garments carry");
  sub.add_flag("--strip", a.strip, "one picture a garment, side by side from the same camera");
  sub.add_option("--captions", a.captions, "words under the pictures of a strip, separated by commas");
  add_camera_options(sub, a.camera);
}

const Subcommand render_subcommand(
    120, "render",
    "Make a picture of meshes, without a display\n\n"
    "  furrow render worn.ply --body body.obj -o worn.png\n"
    "  furrow render worn.ply --body body.obj --figure --no-lines --colour #7a2f3b -o shop.png\n"
    "  furrow render shirt.obj --view front -o view.png --save-camera cam.json\n"
    "  furrow render --strip a.obj b.ply c.ply --captions drawn,smoothed,hung -o strip.png",
    add_render, render);

}  // namespace
}  // namespace furrow::cli
