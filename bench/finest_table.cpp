// SPDX-License-Identifier: GPL-3.0-or-later
// Garments that are refined where they fold beside the same refined everywhere, as a table of markdown: each
// is draped twice by `furrow drape`'s defaults, with `subdivide` N and with `finest`, at the threads of the
// machine.
//   finest_table FINEST GARMENT BODY N [GARMENT BODY N …]
// FINEST: [m]. Seconds: processor time of all threads, the reading of body and garment included. Apart:
// distance of the one surface from the other, by area.
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "geometry/mesh/mesh.h"
#include "geometry/refine/surface_deviation.h"
#include "io/scene/scene.h"
#include "jobs/rest/drape.h"

using namespace furrow;

namespace {

double seconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

struct Run {
  jobs::Draped draped;
  double seconds;
};

Run run(const char* garment, const char* body, std::optional<int> subdivide, std::optional<double> finest) {
  jobs::DrapeJob job;
  job.scene.settings = io::parse_toml("[garment]\n", "finest_table");
  io::set_value(job.scene.settings, "garment.mesh", garment, "finest_table");
  io::set_value(job.scene.settings, "body.mesh", body, "finest_table");
  job.subdivide = subdivide;
  job.settings.finest = finest;
  job.budget = 600;
  jobs::Listener listener;
  const double begin = seconds();
  jobs::DrapeJobReport report = jobs::drape(job, listener);
  return {std::move(report.garments.at(0)), seconds() - begin};
}

void row(double finest, const std::string& garment, const char* body, int subdivide) {
  const Run uniform = run(garment.c_str(), body, subdivide, {}),
            local = run(garment.c_str(), body, {}, finest);
  const geometry::Mesh &all = uniform.draped.file.mesh, &some = local.draped.file.mesh;
  const geometry::SurfaceDeviation apart = geometry::surface_deviation(all, some);
  const std::size_t slash = garment.find_last_of('/') + 1;
  const auto p99 = [](const Run& r) { return r.draped.fit.strain ? 100 * r.draped.fit.strain->p99 : 0; };
  std::printf(
      "| %s | %zu, %zu | %.1f, %.1f (%.1f ×) | %.2f, %.2f | %.2f, %.2f %% | %.1f, %.1f | %zu, %zu |%s\n",
      garment.substr(slash, garment.rfind('.') - slash).c_str(), std::size_t(all.number_of_vertices()),
      std::size_t(some.number_of_vertices()), uniform.seconds, local.seconds, uniform.seconds / local.seconds,
      1e3 * apart.median, 1e3 * apart.p95, p99(uniform), p99(local), uniform.draped.angle_defect,
      local.draped.angle_defect, uniform.draped.crossings.pairs, local.draped.crossings.pairs,
      uniform.draped.succeeds() && local.draped.succeeds() ? "" : " not at rest");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 5 || argc % 3 != 2) throw std::invalid_argument("usage: finest_table FINEST GARMENT BODY N …");
  std::puts(
      "| garment | vertices: all, some | seconds | apart: median, p95 [mm] | strain p99 | angle defect "
      "[rad/m²] | "
      "crossings |\n| --- | --- | --- | --- | --- | --- | --- |");
  for (int i = 2; i + 2 < argc; i += 3) row(std::stod(argv[1]), argv[i], argv[i + 1], std::stoi(argv[i + 2]));
} catch (const std::exception& e) {
  std::fprintf(stderr, "error: %s\n", e.what());
  return 1;
}
