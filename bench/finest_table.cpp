// SPDX-License-Identifier: GPL-3.0-or-later
// What it costs to know how a garment rests, refined everywhere and where it folds: error against cost, as a
// table of markdown. It is draped by `furrow drape`'s defaults with `subdivide` 0 to N and with each `finest`
// [m], at the threads of the machine.
//   finest_table GARMENT BODY N FINEST…
// Apart: distance by area from the rest of `subdivide` N. Seconds: processor time of all threads, the reading
// of body and garment included.
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

void row(const std::string& name, const Run& run, const Run& best) {
  const geometry::Mesh &fine = best.draped.file.mesh, &mesh = run.draped.file.mesh;
  const geometry::SurfaceDeviation apart = geometry::surface_deviation(fine, mesh);
  std::printf("| %s | %zu | %.1f | %.2f, %.2f | %.2f %% | %.1f | %zu |%s\n", name.c_str(),
              std::size_t(mesh.number_of_vertices()), run.seconds, 1e3 * apart.median, 1e3 * apart.p95,
              run.draped.fit.strain ? 100 * run.draped.fit.strain->p99 : 0, run.draped.angle_defect,
              run.draped.crossings.pairs, run.draped.succeeds() ? "" : " not at rest");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 4) throw std::invalid_argument("usage: finest_table GARMENT BODY N FINEST…");
  const int levels = std::stoi(argv[3]);
  const Run best = run(argv[1], argv[2], levels, {});
  std::puts(
      "| refined | vertices | seconds | apart: median, p95 [mm] | strain p99 | angle defect [rad/m²] | "
      "crossings "
      "|\n| --- | --- | --- | --- | --- | --- | --- |");
  for (int i = 0; i < levels; ++i)
    row("`--subdivide " + std::to_string(i) + "`", run(argv[1], argv[2], i, {}), best);
  row("`--subdivide " + std::to_string(levels) + "`", best, best);
  for (int i = 4; i < argc; ++i)
    row(std::string("`--finest ") + argv[i] + "`", run(argv[1], argv[2], {}, std::stod(argv[i])), best);
} catch (const std::exception& e) {
  std::fprintf(stderr, "error: %s\n", e.what());
  return 1;
}
