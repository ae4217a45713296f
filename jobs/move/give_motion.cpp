// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/move/give_motion.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/scene/settings_table.h"
#include "jobs/base/read_inputs.h"
#include "jobs/move/simulate.h"
#include "physics/base/progress.h"

namespace furrow::jobs {
namespace {

namespace fs = std::filesystem;

const std::string unfinished = "unfinished-";

/// The motion was made before, and what it takes was allowed then.
class SecondRun : public Listener {
 public:
  explicit SecondRun(Listener& other) : other_(other) {}
  void progress(const std::string& what, double share) override { other_.progress(what, share); }
  void warn(const Warning& warning) override { other_.warn(warning); }
  bool cancelled() override { return other_.cancelled(); }
  bool allows(const std::string&) override { return true; }  // it has moved so long before
  bool replaces(const std::string&) override { return true; }

 private:
  Listener& other_;
};

}  // namespace

std::vector<fs::path> give_motion(const fs::path& scene, const fs::path& to, Listener& listener) {
  SecondRun again(listener);
  const fs::path beside = fs::absolute(to).parent_path() / (unfinished + to.filename().string());
  SimulateJob job;
  job.scene.settings = settings_of(scene.string(), "", std::nullopt);
  job.scene.folder = scene.parent_path();
  io::set_value(job.scene.settings, "output.animation", beside.string(), "the studio");
  job.outputs_below = beside.parent_path();
  const SimulateReport report = simulate(job, again);
  const bool whole =
      report.run.outcome == physics::Outcome::finished || report.run.outcome == physics::Outcome::stopped_at;
  std::vector<fs::path> written;
  for (const AnimationReport& part : report.animations) {
    const fs::path place = part.file.parent_path() / part.file.filename().string().substr(unfinished.size());
    std::error_code none;
    whole ? fs::rename(part.file, place) : void(fs::remove(part.file, none));
    written.push_back(place);
  }
  if (whole) return written;
  if (!report.failure.empty()) throw std::runtime_error(report.failure);
  throw physics::Cancelled("cancelled");
}

}  // namespace furrow::jobs
