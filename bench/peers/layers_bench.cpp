// SPDX-License-Identifier: GPL-3.0-or-later
// What a search for rest of two garments costs, draped as `furrow drape` does: processor seconds.
//   layers_bench INNER OUTER BODY REFINEMENTS
// From where the body's field is built to the last step: without reading the body, its field, judging and
// writing.
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "jobs/rest/drape.h"
#include "physics/motion/work_clock.h"

namespace furrow::bench {
namespace {

/// Notes when the search began and when it told of its last step.
class SearchClock : public jobs::Listener {
 public:
  void progress(const std::string& what, double share) override {
    const double now = physics::processor_seconds();
    if (what != "draping" && end_ == 0) begin_ = now;
    if (what == "draping" && share < 1) end_ = now;
  }
  double seconds() const { return end_ - begin_; }

 private:
  double begin_ = 0, end_ = 0;
};

}  // namespace
}  // namespace furrow::bench

int main(int count, char** words) {
  try {
    if (count != 5) throw std::invalid_argument("INNER OUTER BODY REFINEMENTS");
    furrow::jobs::DrapeJob job;
    job.scene.settings = furrow::io::TomlDocument{};
    furrow::io::set_value(job.scene.settings, "garment.mesh", words[1], "the command line");
    furrow::io::set_value(job.scene.settings, "body.mesh", words[3], "the command line");
    job.over = {words[2]};
    job.subdivide = std::stoi(words[4]);
    furrow::bench::SearchClock clock;
    const auto report = furrow::jobs::drape(job, clock);
    if (!report.garments.at(0).rests()) throw std::runtime_error("the garments did not come to rest");
    std::printf("%.3f\n", clock.seconds());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "layers_bench: %s\n", e.what());
    return 2;
  }
}
