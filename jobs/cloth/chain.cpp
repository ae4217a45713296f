// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/chain.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "io/animation/animation_file.h"

namespace furrow::jobs {
namespace {

using geometry::Mesh, geometry::Strut, geometry::Vertex;

constexpr double usual_line_stretch = 1000;  // EA [N]
constexpr double usual_line_density = 0.01;  // [kg/m]

/// The links of the lines, each pair of vertices once, without a stiffness.
std::vector<Strut> links_of_lines(const io::MeshFile& file) {
  std::vector<std::array<std::size_t, 2>> pairs;
  for (const io::Polyline& line : file.polylines) {
    const std::vector<std::size_t>& v = line.vertices;
    for (std::size_t i = 0; i + 1 < v.size(); ++i) pairs.push_back({v[i], v[i + 1]});
    if (line.closed) pairs.push_back({v.back(), v.front()});
  }
  for (auto& pair : pairs) std::ranges::sort(pair);
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<Strut> links;
  for (const auto& [a, b] : pairs) {
    const Vertex v{Vertex::size_type(a)}, w{Vertex::size_type(b)};
    const double length = std::sqrt((file.mesh->point(w) - file.mesh->point(v)).squared_length());
    if (!(length > 0))
      throw geometry::ContentError("the line from vertex " + std::to_string(a) + " to " + std::to_string(b) +
                                   " has no length; merge them");
    links.push_back({v, w, length, 0});
  }
  return links;
}

bool has_masses_at(const Mesh& mesh, const std::vector<Strut>& links) {
  const auto mass = geometry::find_map(mesh, geometry::attribute::mass);
  return mass && std::ranges::all_of(links, [&](const Strut& link) {
           return std::isfinite((*mass)[link.a]) && std::isfinite((*mass)[link.b]);
         });
}

void lump_link_masses(Mesh& mesh, const std::vector<Strut>& links, double density) {
  auto mass = geometry::ensure_map(mesh, geometry::attribute::mass);
  for (const Vertex v : mesh.vertices()) mass[v] = 0;
  for (const Strut& link : links)
    for (const Vertex end : {link.a, link.b}) mass[end] += density * link.rest_length / 2;
}

void require_outputs(const io::SceneOutput& out) {
  for (const auto& path : {out.mesh, out.inserted, out.smoothed, out.settled}) {
    if (path.empty()) continue;
    const io::MeshFormat format = io::mesh_format(path);
    if (format != io::MeshFormat::obj && format != io::MeshFormat::ply)
      throw std::invalid_argument(path.string() +
                                  ": the format has faces alone, and the garment is a chain; "
                                  "write an .obj or a .ply");
  }
  if (io::animation_format(out.animation) == io::AnimationFormat::glb)
    throw std::invalid_argument(
        out.animation.string() +
        ": a GLB of ours has faces, and the garment is a chain; write a .pc2 or .mdd");
}

}  // namespace

std::vector<Strut> chain_links(const io::MeshFile& file) {
  std::vector<Strut> links = geometry::struts(file.mesh);
  return links.empty() ? links_of_lines(file) : links;
}

void complete_chain(io::MeshFile& file, const io::SceneMaterial& material) {
  std::vector<Strut> links = chain_links(file);
  if (links.empty()) throw geometry::ContentError("no faces, and no lines that join its vertices");
  const bool drawn = geometry::struts(file.mesh).empty();
  if (drawn || material.line_stretch) {
    for (Strut& link : links)
      link.stiffness = material.line_stretch.value_or(usual_line_stretch) / link.rest_length;  // k = EA / L
    geometry::set_struts(file.mesh, links);
  }
  if (material.line_density || !has_masses_at(file.mesh, links))
    lump_link_masses(file.mesh, links, material.line_density.value_or(usual_line_density));
}

double length_of(const std::vector<Strut>& links) {
  double sum = 0;
  for (const Strut& link : links) sum += link.rest_length;
  return sum;
}

void check_chain(const io::Scene& scene, const Mesh& mesh, const Context& context) {
  const io::SceneMaterial& m = scene.material;
  const std::string name = scene.garment.string();
  if (!geometry::is_chain(mesh)) {
    if (m.line_stretch || m.line_density)
      context.warn("chain_settings",
                   name +
                       ": has faces, so line_stretch and line_density do nothing: cloth has stretch and "
                       "density",
                   name, m.line_stretch ? "material.line_stretch" : "material.line_density");
    return;
  }
  const auto refuse = [&](const char* option, const char* why) {
    throw std::invalid_argument(std::string(option) + ": the garment is a chain, without faces; " + why);
  };
  if (!scene.lines.empty()) refuse("lines", "lines are drawn on cloth: leave them out");
  if (scene.subdivide > 0) refuse("`subdivide`", "give its file more vertices");
  if (scene.simulation.self.on && !(scene.body && !scene.body->frames.empty()))
    refuse("`self_contact=on`", "it has no surface that could touch: leave it out");
  if (scene.keep) refuse("`rest=keep`", "its rest lengths are those of its file: leave it out");
  require_outputs(scene.output);
  if (!m.by_default && (m.density || m.stretch || !m.preset.empty()))
    context.warn("chain_settings",
                 name +
                     ": is a chain, whose stiffness and mass are line_stretch and line_density; fabric, "
                     "stretch and density do nothing",
                 name, "material");
}

void refuse_chain(const Mesh& mesh, const std::string& name) {
  if (geometry::is_chain(mesh))
    throw geometry::ContentError(name +
                                 ": a chain, which `furrow simulate` moves; here a mesh with faces is "
                                 "needed");
}

}  // namespace furrow::jobs
