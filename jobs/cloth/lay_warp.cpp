// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/lay_warp.h"

#include <cmath>

#include "geometry/mesh/edge_metric.h"
#include "geometry/rest/spread_warp.h"
#include "geometry/stroke/trace_stroke.h"
#include "io/stroke/resolve_strokes.h"
#include "io/stroke/stroke_file.h"
#include "jobs/base/read_inputs.h"

namespace furrow::jobs {
namespace {

using geometry::Vector, geometry::WarpCount;

bool is_stroke_file(const std::string& source) { return source.find('.') != std::string::npos; }

/// What is known of a garment's warp before anybody says anything.
std::string usual_source(const geometry::Mesh& mesh) {
  if (geometry::count_warp(mesh).known > 0) return "file";
  const auto texture = geometry::find_map(mesh, geometry::attribute::texture);
  if (texture)
    for (const geometry::Face f : mesh.faces())
      if (std::isfinite((*texture)[mesh.halfedge(f)][0])) return "texture";
  return "y";
}

/// The warp runs along each step of the strokes, in the face that the step lies in.
WarpCount warp_by_strokes(io::MeshFile& file, const std::string& path, const Context& context) {
  geometry::Mesh& mesh = file.mesh;
  const auto drawn = io::read_drawn_strokes(path, geometry::Stroke{}.height, read_options(context.frame));
  const io::ResolvedStrokes resolved = io::resolve_strokes(drawn, file);
  for (const std::string& w : resolved.warnings) context.warn("drawing", w, path);
  const geometry::SurfaceProjector projector(mesh);
  geometry::TraceOptions options;
  for (const geometry::Edge e : mesh.edges())
    options.mean_edge += geometry::spatial_length(mesh, e) / double(mesh.number_of_edges());
  std::vector<geometry::WarpHint> hints;
  for (const geometry::Stroke& stroke : resolved.strokes) {
    const geometry::TracedStroke traced = trace_stroke(mesh, projector, stroke, options);
    for (const std::string& w : traced.warnings) context.warn("drawing", w, path);
    for (const geometry::SubStroke& part : traced.sub_strokes)
      for (const geometry::CrossedFace& visit : part.faces) {
        const auto node = geometry::position_of(mesh, {visit.face, visit.node});
        if (visit.entry && visit.exit)
          hints.push_back({visit.face, visit.exit->position - visit.entry->position});
        else if (visit.entry || visit.exit)
          hints.push_back(
              {visit.face, visit.entry ? node - visit.entry->position : visit.exit->position - node});
      }
    for (std::size_t i = 1; i < traced.samples.size(); ++i)  // a stroke inside one face
      if (traced.samples[i].point.face == traced.samples[i - 1].point.face)
        hints.push_back(
            {traced.samples[i].point.face, traced.samples[i].position - traced.samples[i - 1].position});
  }
  return geometry::set_warp_by_hints(mesh, hints);
}

WarpCount warp_by(const std::string& source, io::MeshFile& file, const Context& context) {
  geometry::Mesh& mesh = file.mesh;
  if (source == "texture" || source == "texture-u")
    return geometry::set_warp_by_texture(
        mesh, source == "texture" ? geometry::TextureAxis::v : geometry::TextureAxis::u);
  if (source == "x" || source == "y" || source == "z") {
    const bool up_is_z = context.frame.up_in_use() == "z";  // the axes of the user's file
    const Vector axis = source == "x"                ? Vector(1, 0, 0)
                        : (source == "y") != up_is_z ? Vector(0, 1, 0)
                                                     : Vector(0, 0, 1);
    return geometry::set_warp_along(mesh, axis);
  }
  if (source != "file") return warp_by_strokes(file, source, context);
  const WarpCount count = geometry::count_warp(mesh);
  if (count.known == 0)
    throw geometry::ContentError(
        "has no directions of the warp (face properties warp_x, warp_y, warp_z of a PLY) for `warp=file`; "
        "take `warp=texture`, an axis or a stroke file");
  return count;
}

std::string words_of(const std::string& source) {
  if (source == "texture") return "as v grows in its texture";
  if (source == "file") return "as its file says";
  return "along the axis " + source + " (up)";
}

/// What was taken though nobody said so, and what a texture has that threads have not.
void warn_of_source(const std::string& source, bool assumed, const WarpCount& given,
                    const std::string& garment, const Context& context) {
  if (assumed && source != "file")
    context.warn("warp_assumed",
                 garment + ": nothing says where its threads run; the warp runs " + words_of(source) +
                     " (`warp` says otherwise)",
                 garment, "material.warp");
  if (given.skewed * 20 > given.faces)
    context.warn("warp_skewed",
                 garment + ": the texture of " + std::to_string(given.skewed) + " of " +
                     std::to_string(given.faces) +
                     " faces is not at right angles; their weft is taken across the warp",
                 garment, "material.warp");
}

}  // namespace

void lay_warp(io::MeshFile& file, const std::string& said, bool woven, const std::string& garment,
              const Context& context) {
  if (said == "none" || (said == "auto" && !woven)) return;
  const bool up_is_z = context.frame.up_in_use() == "z";
  const std::string usual = usual_source(file.mesh);
  const std::string source = said == "auto" ? (usual == "y" && up_is_z ? "z" : usual) : said;
  if (!woven)
    context.warn("warp_unused",
                 "`warp`: this cloth is the same in all directions; name a fabric with threads "
                 "(furrow fabric list)",
                 garment, "material.preset");
  const WarpCount given = naming(garment, [&] { return warp_by(source, file, context); });
  warn_of_source(source, said == "auto", given, garment, context);
  const WarpCount all = geometry::spread_warp(file.mesh);
  if (given.known < given.faces && !is_stroke_file(source))
    context.warn("warp_spread",
                 garment + ": " + std::to_string(given.faces - given.known) + " of " +
                     std::to_string(given.faces) + " faces have no warp by `warp=" + source +
                     "`; they take it from their neighbours",
                 garment, "material.warp");
  if (all.known == all.faces) return;
  throw geometry::ContentError(
      garment + ": " + std::to_string(all.faces - all.known) + " of " + std::to_string(all.faces) +
      " faces have no direction of the warp, nor a neighbour that has; draw one on each "
      "part (`warp=strokes.json`), or take an axis");
}

}  // namespace furrow::jobs
