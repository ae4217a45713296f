// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/camera_options.h"

#include <cmath>
#include <map>
#include <thread>

#include "cli/help.h"
#include "io/base/camera_file.h"

namespace furrow::cli {
namespace {

/// Azimuth and elevation [degrees] of the named views.
const std::map<std::string, std::pair<double, double>> views{{"three-quarter", {25, 8}}, {"front", {0, 0}},
                                                             {"back", {180, 0}},         {"left", {90, 0}},
                                                             {"right", {-90, 0}},        {"top", {0, 85}}};
const std::map<std::string, io::Quality> qualities{
    {"draft", io::Quality::draft}, {"normal", io::Quality::normal}, {"fine", io::Quality::fine}};

constexpr double wire_pixels = 0.6;

io::Position position(const std::string& text, const std::string& option) {
  const std::vector<double> x = parse_numbers(text, 3, option);
  return {x[0], x[1], x[2]};
}

void set_size(io::RenderOptions& options, const std::string& text) {
  const std::vector<double> size = parse_numbers(text, 2, "--size");
  for (double side : size)
    if (!(side >= 1 && side <= 16384) || side != std::floor(side))
      throw UsageError("--size takes two whole numbers from 1 to 16384, not '" + text + "'");
  options.width = static_cast<int>(size[0]);
  options.height = static_cast<int>(size[1]);
}

io::Camera camera_of(std::span<const io::RenderScene> scenes, const io::RenderOptions& options,
                     const CameraArguments& a) {
  if (a.eye.empty() != a.target.empty()) throw UsageError("--eye and --target go together");
  io::Camera camera = io::automatic_camera(scenes, options);
  if (!a.eye.empty()) {
    camera.eye = position(a.eye, "--eye");
    camera.target = position(a.target, "--target");
  }
  if (!a.up_vector.empty()) camera.up = position(a.up_vector, "--camera-up");
  camera.field_of_view_deg = a.field_of_view;
  camera.parallel_height = a.parallel;
  return camera;
}

}  // namespace

io::RenderOptions render_options(std::span<const io::RenderScene> scenes, const CameraArguments& a) {
  io::RenderOptions options;
  options.quality = qualities.at(a.quality);
  options.thickness = a.thickness;
  options.oversample = a.oversample;
  if (a.wire) options.wire_pixels = wire_pixels;
  options.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  if (!a.camera.empty()) {
    const io::CameraPicture picture = io::read_camera(a.camera);
    options.camera = picture.camera;
    options.width = picture.width;
    options.height = picture.height;
    return options;
  }
  if (!(a.field_of_view >= 1 && a.field_of_view <= 150))
    throw UsageError("--fov takes 1 to 150 degrees, not " + Json(a.field_of_view).dump());
  set_size(options, a.size);
  options.view.azimuth_deg = views.at(a.view).first;
  options.view.elevation_deg = views.at(a.view).second;
  options.view.field_of_view_deg = a.field_of_view;
  options.camera = camera_of(scenes, options, a);
  io::check(io::CameraPicture{*options.camera, options.width, options.height});
  return options;
}

Json save_camera(const io::RenderOptions& options, const CameraArguments& a) {
  const io::CameraPicture picture{*options.camera, options.width, options.height};
  if (!a.save_camera.empty()) io::write_camera(a.save_camera, picture);
  return io::to_json(picture);
}

void add_camera_options(CLI::App& sub, CameraArguments& a) {
  begin_group(sub, group::picture, Audience::few);
  CLI::Option* file = sub.add_option("--camera", a.camera,
                                     "the camera of an earlier picture, which --save-camera wrote; in place "
                                     "of all that follows");
  const auto add = [&](const char* name, auto& value, const char* help) {
    return sub.add_option(name, value, help)->excludes(file);
  };
  add("--eye", a.eye, "where the camera stands: x,y,z [m, y up]; with --target, in place of --view");
  add("--target", a.target, "what it looks at: x,y,z [m, y up]");
  add("--camera-up", a.up_vector, "what points up in the picture: x,y,z; default 0,1,0");
  add("--fov", a.field_of_view, "vertical opening of the camera [degrees]")->capture_default_str();
  add("--orthographic", a.parallel, "parallel lines of sight in place of --fov: the picture's height [m]");
  add("--size", a.size, "width,height of each picture [pixels]")->capture_default_str();
  sub.add_option("--save-camera", a.save_camera,
                 "write the camera as JSON: strokes in a stroke file can be drawn in its pixels");
  sub.add_option("--oversample", a.oversample,
                 "make the picture so many times as large, and each pixel the mean of a square: finer, and "
                 "slower; 1 to 8")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  sub.add_option("--thickness", a.thickness,
                 "of the cloth in the picture [m], 0 to 1; 0 for none. At most 1/200 of the scene is shown")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  sub.add_flag("--wire", a.wire, "show the edges of the cloth's mesh");
  begin_group(sub, group::picture);
  add("--view", a.view, "from where: front, back, left, right, top or three-quarter")
      ->check(CLI::IsMember(views))
      ->capture_default_str();
  sub.add_option("--quality", a.quality, "draft, normal or fine")
      ->check(CLI::IsMember(qualities))
      ->capture_default_str();
}

}  // namespace furrow::cli
