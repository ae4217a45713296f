// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/fit_picture.h"

#include <fmt/format.h>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/vertex_attributes.h"
#include "io/picture/render_scene.h"
#include "io/picture/strip.h"
#include "jobs/base/read_inputs.h"

namespace furrow::jobs {
namespace {

constexpr io::Colour figure_colour{0.56f, 0.56f, 0.57f};  // no colour of either scale

io::RenderScene scene_of(const FitPanel& panel) {
  io::RenderScene scene;
  scene.meshes.push_back(io::render_mesh_from(*panel.garment, io::Style::cloth));
  io::mark_faces(scene.meshes.back(), panel.crossed);
  for (const geometry::Mesh* garment : panel.over)
    scene.meshes.push_back(io::render_mesh_from(*garment, io::Style::cloth));
  if (!panel.body) return scene;
  io::RenderMesh body = io::render_mesh_from(*panel.body, io::Style::body);
  body.colour = figure_colour;
  body.vertex_colours.clear();
  body.framed = false;
  scene.meshes.push_back(std::move(body));
  return scene;
}

}  // namespace

std::string fit_words(const bridge::FitReport& report, const bridge::FitOptions& options, FitColour colour) {
  std::string words;
  if (colour == FitColour::strain && report.strain)
    words = fmt::format("{:.1f} % of the cloth strained over {:.3g} %", 100 * report.strain->share_over,
                        100 * options.tight_strain);
  else
    words = fmt::format("half of the cloth nearer than {:.0f} mm", 1000 * report.distance.median);
  if (report.piercing.faces)
    words += fmt::format("; the body comes through {} face{} by {:.1f} mm", report.piercing.faces,
                         report.piercing.faces == 1 ? "" : "s", 1000 * report.distance.deepest_penetration);
  std::string rooms;
  for (const bridge::FitEase& e : report.ease)
    if (e.ease)
      rooms +=
          (rooms.empty() ? "ease: " : ", ") + e.name + fmt::format(" {:+.1f} cm", 100 * *e.ease) +
          (e.rest_ease && *e.rest_ease < 0 ? fmt::format(" (unstretched {:+.1f})", 100 * *e.rest_ease) : "");
  return rooms.empty() ? words : words + "\n" + rooms;
}

std::string crossing_words(const ClothCrossings& c) {
  return c.pairs ? "; " + std::to_string(c.pairs) + " pairs of faces cross (magenta)" : "";
}

io::FitScale fit_scale(FitColour colour, const bridge::FitOptions& options,
                       const std::optional<double>& limit) {
  const bool strain = colour == FitColour::strain;
  io::FitScale scale;
  scale.quantity = strain ? io::FitQuantity::strain : io::FitQuantity::distance;
  scale.limit = limit.value_or(strain ? 2 * options.tight_strain : 1.2 * options.loose_distance);
  const double mark = strain ? options.tight_strain : options.loose_distance;
  scale.mark = mark <= scale.limit ? mark : 0;
  return scale;
}

void colour_garment(geometry::Mesh& garment, const io::FitScale& scale) {
  const std::string name =
      scale.quantity == io::FitQuantity::strain ? bridge::fit_strain : bridge::fit_distance;
  for (const geometry::VertexAttribute& attribute : geometry::vertex_attributes(garment)) {
    if (attribute.name != name) continue;
    std::vector<double> values(garment.num_vertices(), 0);
    for (geometry::Vertex v : garment.vertices()) values[v.idx()] = attribute.values[v];
    return io::colour_by_fit(garment, values, scale);
  }
  throw geometry::ContentError("the garment has no vertex attribute '" + name + "' to colour it by");
}

std::vector<io::RenderScene> fit_scenes(std::span<const FitPanel> panels) {
  std::vector<io::RenderScene> scenes;
  for (const FitPanel& panel : panels) scenes.push_back(scene_of(panel));
  return scenes;
}

io::Image fit_picture(std::span<const FitPanel> panels, std::span<const io::RenderScene> scenes,
                      const io::FitScale& scale, io::RenderOptions options, bool view_chosen,
                      Listener& listener, bool legend) {
  const bool both_sides = panels.size() == 1 && !view_chosen;
  const std::size_t pictures = both_sides ? 2 : scenes.size();
  const ProgressScope progress(listener, "rendering");
  std::vector<io::Panel> strip;
  for (std::size_t i = 0; i < pictures; ++i) {
    if (both_sides && i == 1) {
      options.view.azimuth_deg += 180;
      options.camera = io::automatic_camera(scenes, options);
    }
    strip.push_back({io::render(scenes[both_sides ? 0 : i], options),
                     both_sides ? (i ? "back" : "front") : panels[i].caption});
    progress(double(i + 1) / double(pictures));
  }
  std::string words = both_sides ? panels[0].caption : "";
  if (const std::size_t end = words.find('\n'); end != std::string::npos) words.replace(end, 1, "; ");
  io::StripOptions letters;
  letters.text_height = 0.02;
  const io::Image image = io::strip(strip, letters);
  return legend ? io::with_fit_legend(image, scale, words) : image;
}

}  // namespace furrow::jobs
