// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/prepare_garment.h"

#include <algorithm>
#include <cmath>

#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "geometry/mesh/vertex_attributes.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/masses.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/rest/stiffness.h"
#include "io/scene/fabrics.h"
#include "jobs/cloth/chain.h"
#include "physics/plate/plate_rigidity.h"

namespace furrow::jobs {
namespace {

bool has_masses(const geometry::Mesh& mesh) {
  const auto mass = geometry::find_map(mesh, geometry::attribute::mass);
  const auto known = [&](geometry::Vertex v) { return mesh.is_isolated(v) || std::isfinite((*mass)[v]); };
  return mass && std::all_of(mesh.vertices().begin(), mesh.vertices().end(), known);
}

bridge::Weave weave_of(const io::SceneMaterial& m) {
  const double warp = *m.warp_rigidity, weft = *m.weft_rigidity;
  return {*m.warp_stretch,
          *m.weft_stretch,
          *m.thread_shear,
          m.thread_poisson,
          warp,
          weft,
          physics::twist_of_bias(warp, weft, *m.bias_rigidity)};
}

}  // namespace

void complete_garment(io::MeshFile& file, const io::SceneMaterial& material) {
  using namespace geometry;
  Mesh& mesh = file.mesh;
  ensure_rest_positions(mesh);
  ensure_rest_lengths(mesh);
  ensure_bending_springs(mesh);
  ensure_rest_angles(mesh);
  io::WrinkleRecord record = io::find_wrinkle_record(file).value_or(io::WrinkleRecord{});
  const bool denser = material.density && *material.density != record.density;
  if (material.density || !(record.density > 0))
    record.density = material.density.value_or(WrinkleOptions{}.density);
  const bool chain = is_chain(mesh);
  if (chain)
    complete_chain(file, material);
  else if (denser || !has_masses(mesh))
    lump_masses(mesh, record.density);
  if (!(record.mean_structural_length > 0))
    record.mean_structural_length =
        chain ? length_of(struts(mesh)) / double(struts(mesh).size()) : mean_rest_length(mesh);
  if (!(record.mean_bending_length > 0)) record.mean_bending_length = mean_bending_rest_length(mesh);
  record.unit = "m", record.up = "y";  // as the mesh is here; who writes it in another unit notes that one
  io::set_wrinkle_record(file, record);
}

bridge::GatherOptions spring_options(const io::MeshFile& file, const io::SceneMaterial& material) {
  const io::WrinkleRecord record = io::find_wrinkle_record(file).value();
  bridge::GatherOptions o;
  o.structural_stiffness =
      material.stretch ? bridge::spring_constant_of(*material.stretch) : material.stiffness;
  o.bending_stiffness = material.bending;
  o.mean_structural_length = record.mean_structural_length;
  o.mean_bending_length = record.mean_bending_length;
  o.membrane = material.membrane;
  o.bending = material.bending_law;
  // A sheet as stiff as the springs would be on equilateral triangles.
  o.stretch = material.stretch.value_or(material.stiffness / bridge::spring_constant_of(1));
  o.poisson = material.poisson;
  o.rigidity = material.rigidity;
  o.tension = material.tension.value_or(io::tension_constant(o.stretch));
  o.compression = material.compression;
  o.shear = material.shear;
  o.mass_rule = material.mass_rule;
  if (material.is_woven()) o.weave = weave_of(material);
  o.line_presses = io::line_presses(record);
  o.line_widths = io::line_widths(record);
  return o;
}

}  // namespace furrow::jobs
