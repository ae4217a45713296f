// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/gate.h"

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/mesh/errors.h"
#include "jobs/body/field.h"
#include "jobs/mesh/subdivide.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// Lets everything pass, and remembers what.
class Generous : public tests::Recorder {
 public:
  bool allows(const std::string& demand) override {
    demands.push_back(demand);
    return true;
  }
  std::vector<std::string> demands;
};

jobs::Frame in_unit(const std::string& unit) {
  jobs::Frame frame;
  frame.unit = unit;
  return frame;
}

geometry::Mesh own_mesh(const std::string& name) {
  return tests::read_plain_obj(tests::source_dir() / "meshes" / name);
}

}  // namespace

TEST_CASE("gate: a size that another unit explains is asked about by that unit's name") {
  const geometry::Mesh small = tests::icosphere(2, 0.00085), person = tests::icosphere(2, 0.85);
  CHECK(jobs::odd_size(person, "body", in_unit("m")).empty());
  CHECK_THAT(jobs::odd_size(small, "body", in_unit("mm")),
             Contains("the body is 1.7 mm in size with `unit=mm`; say `unit=m` if its file is in that"));
  CHECK_THAT(jobs::odd_size(tests::icosphere(2, 0.01), "garment", in_unit("mm")),
             Contains("`unit=cm or inch`"));
  CHECK_THAT(jobs::odd_size(small, "body", in_unit("m")),
             Contains("no `unit` makes it a person's; scale it"));
  CHECK_THAT(jobs::odd_size(tests::icosphere(2, 850), "body", in_unit("m")), Contains("m tall"));
  // A swatch is small, and may well be.
  CHECK(jobs::odd_size(tests::icosphere(2, 0.01), "garment", in_unit("m")).empty());
}

TEST_CASE("gate: what is allowed goes on, and what is not is refused with the way to allow it") {
  const geometry::Mesh small = tests::icosphere(2, 1e-6);
  jobs::Listener nobody;
  CHECK_THROWS_WITH(jobs::require_size(small, "b.obj", "body", {jobs::Frame(), nobody}),
                    Catch::StartsWith("b.obj: the body is") && Contains("`force`"));
  Generous generous;
  const jobs::Context context{jobs::Frame(), generous};
  jobs::require_size(small, "b.obj", "body", context);
  jobs::require_animation(10, 1e9, 3000, context);
  jobs::require_refinement(10000, 4, 8, "subdivide", context);
  REQUIRE(generous.demands.size() == 3);
  CHECK_THAT(generous.demands[1], Contains("`fps=1e+09`: the animation would have 1e+10 frames"));
  CHECK_THAT(generous.demands[2], Contains("`subdivide=8`: the mesh would have 6.6e+08 faces"));
  const jobs::Context strict{jobs::Frame(), nobody};
  CHECK_THROWS_WITH(jobs::require_animation(10, 1e9, 3000, strict), Contains("`force` goes on all the same"));
  CHECK_THROWS_AS(jobs::require_refinement(10000, 4, 8, "subdivide", strict), std::invalid_argument);
  CHECK_NOTHROW(jobs::require_refinement(10000, 4, 4, "subdivide", strict));
  CHECK_NOTHROW(jobs::require_animation(100, 240, 10000, strict));
}

TEST_CASE("gate: a simulation of more than a day of processor time is asked about once") {
  jobs::Listener nobody;
  const jobs::Context strict{jobs::Frame(), nobody};
  const physics::SimulateProgress slow{0.0, 100, 1e-9, 0}, fast{0.0, 100, 1e-4, 0};
  jobs::SimulationGate gate(2, true, 1e-3, strict);
  CHECK_NOTHROW(gate.check(fast));
  CHECK_THROWS_WITH(gate.check(slow), Contains("2e+09 steps of 1e-09 s") && Contains("23 days") &&
                                          Contains("take a longer `dt`"));
  CHECK_THROWS_WITH(jobs::SimulationGate(2, false, 1e-3, strict).check(slow), Contains("`density`"));
  Generous generous;
  const jobs::Context open{jobs::Frame(), generous};
  jobs::SimulationGate asked(2, true, 1e-3, open);
  asked.check(slow);
  asked.check(slow);
  CHECK(generous.demands.size() == 1);
}

TEST_CASE(
    "gate: a flat sheet in the wrong unit is refused, whichever way it lies, and a wide floor is none") {
  geometry::Mesh sheet = tests::grid(2, 2);
  for (geometry::Point& p : sheet.points()) p = {300 * p.x(), p.y() * 0, 300 * p.y()};
  CHECK_THAT(jobs::odd_size(sheet, "garment", {}), Contains("wide; if its file is not in metres"));
  CHECK(jobs::odd_size(sheet, "body", {}).empty());
}

TEST_CASE("gate: a body given as its own garment, a body as garment, and half a garment are named") {
  const geometry::Mesh figure = own_mesh("mannequin.obj"), skirt = own_mesh("skirt.obj");
  const jobs::BodyOutline body = jobs::outline_of(figure);
  const auto codes = [&](const geometry::Mesh& garment) {
    std::vector<std::string> found;
    for (const jobs::Ailment& a : jobs::faults_of_pair(garment, body, true))
      if (a.code != "body_apart") found.push_back(a.code);
    return found;
  };
  CHECK(codes(skirt).empty());
  CHECK(codes(figure) == std::vector<std::string>{"worn_on_itself"});
  geometry::Mesh other = figure;
  for (geometry::Point& p : other.points()) p = {p.x(), p.y(), p.z() + 0.02};
  CHECK(codes(other) == std::vector<std::string>{"body_as_garment"});
  geometry::Mesh half = skirt;
  for (geometry::Face f : half.faces()) {
    double most = 0;
    for (geometry::Vertex v : half.vertices_around_face(half.halfedge(f)))
      most = std::max(most, std::abs(std::min(0.0, half.point(v).x())));
    if (most > 1e-9) CGAL::Euler::remove_face(half.halfedge(f), half);
  }
  half.collect_garbage();
  double least = 1;
  for (geometry::Vertex v : half.vertices())
    if (!half.is_isolated(v)) least = std::min(least, half.point(v).x());
  for (geometry::Vertex v : half.vertices())  // a cut that lies in a plane
    if (half.is_border(v) && half.point(v).x() < least + 0.02)
      half.point(v) = geometry::Point(least, half.point(v).y(), half.point(v).z());
  CHECK(codes(half) == std::vector<std::string>{"half"});
}

TEST_CASE("gate: a garment without any area is refused by its name") {
  geometry::Mesh line = tests::grid(2, 2);
  CHECK_NOTHROW(jobs::require_area(line, "line.obj"));
  for (geometry::Vertex v : line.vertices()) line.point(v) = geometry::Point(line.point(v).x(), 0, 0);
  CHECK_THROWS_WITH(jobs::require_area(line, "line.obj"),
                    "line.obj: none of its faces has an area, so it is no cloth; repair it");
}

TEST_CASE("gate: a field that needs more than the limit is refused with its body's name, or allowed",
          "[long]") {
  const fs::path folder = tests::empty_folder("gate");
  io::MeshFile ball;
  ball.mesh = tests::icosphere(2, 0.1);
  io::write_mesh(folder / "ball.obj", ball);
  jobs::FieldJob job;
  job.body.mesh = folder / "ball.obj";
  job.body.options.tolerance = 0.001;
  job.body.options.most_samples = 5000;
  job.slice = folder / "ball.png";
  jobs::Listener nobody;
  CHECK_THROWS_WITH(jobs::field(job, nobody), Catch::StartsWith((folder / "ball.obj").string()) &&
                                                  Contains("raise the tolerance to") && Contains("`force`"));
  CHECK(tests::names_in(folder) == std::set<std::string>{"ball.obj"});
  Generous generous;
  jobs::field(job, generous);
  CHECK(generous.demands.size() == 1);
  CHECK(tests::names_in(folder).count("ball.png"));
}

TEST_CASE("gate: a refinement that no memory holds is refused") {
  jobs::SubdivideJob job;
  io::MeshFile ball;
  ball.mesh = tests::icosphere(4, 0.1);
  job.mesh = ball;
  job.refinement = jobs::Refinement::loop;
  job.steps = 6;
  jobs::Listener nobody;
  CHECK_THROWS_WITH(jobs::subdivide(job, nobody), Contains("would have 2.1e+07 faces"));
}
