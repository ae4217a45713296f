// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "geometry/mesh/sheet.h"
#include "io/scene/scene.h"
#include "jobs/rest/drape.h"
#include "tests/test_meshes.h"

namespace furrow::tests {

inline void set(jobs::DrapeJob& job, const std::string& path, const io::Json& value) {
  io::set_value(job.scene.settings, path, value, "the test");
}

/// A square of cloth that lies across a ball, in memory.
inline jobs::DrapeJob across_ball(const std::string& fabric = "cotton") {
  jobs::DrapeJob job;
  geometry::Mesh& sheet = job.scene.memory.meshes["sheet"].mesh;
  sheet = geometry::equilateral_sheet(0.3, 0.3, 0.05);
  for (const geometry::Vertex v : sheet.vertices()) {
    const geometry::Point p = sheet.point(v);
    sheet.point(v) = {p.x(), 0.105, p.y() - 0.15};
  }
  job.scene.memory.meshes["ball"].mesh = icosphere(2, 0.1);
  job.scene.settings = io::parse_toml("[garment]\nmesh = \"sheet\"\n", "test");
  set(job, "body.mesh", "ball");
  set(job, "body.tolerance", 0.005);
  set(job, "material.preset", fabric);
  return job;
}

}  // namespace furrow::tests
