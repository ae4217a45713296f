// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "bridge/arrays/couple_bending.h"
#include "bridge/arrays/gather.h"
#include "bridge/arrays/store_rest_state.h"
#include "bridge/keeping/keep.h"
#include "bridge/keeping/keep_trial.h"
#include "bridge/keeping/try_statics.h"
#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/sheet.h"
#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"
#include "physics/cloth/pins.h"
#include "physics/contact/residual_force.h"
#include "physics/plate/plate_bending.h"
#include "physics/rest/prestress.h"
#include "physics/rest/rigid_imbalance.h"
#include "physics/rest/settle.h"
#include "tests/cases/random_garments.h"
#include "tests/cases/safe_rule.h"

using namespace furrow;
using bridge::KeepOptions;
using bridge::Verdict;

namespace {

const physics::Vec3 gravity(0, -9.81, 0);

/// A sheet that hangs by its upper edge, with a level ridge.
struct Hung {
  geometry::Mesh mesh;
  bridge::GatherOptions material;
  physics::Cloth cloth;
  KeepOptions options;

  explicit Hung(double rigidity, std::optional<double> width = {}, double press = 1, double edge = 0.02,
                bridge::Bending bending = bridge::Bending::hinge, double height = 0.012)
      : mesh(geometry::equilateral_sheet(0.3, 0.3, edge)) {
    geometry::Stroke ridge;
    ridge.height = height;
    ridge.width = width;
    ridge.press = press;
    options.line_widths = material.line_widths = {width.value_or(NAN)};
    options.line_presses = material.line_presses = {press};
    ridge.points = {{-0.08, 0.2, 0}, {0.08, 0.2, 0}};
    const geometry::WrinkleReport report =
        geometry::wrinkle(mesh, std::span(&ridge, 1), furrow::tests::safe_rule());
    material.mean_structural_length = report.mean_structural_length;
    material.mean_bending_length = report.mean_bending_length;
    material.membrane = bridge::Membrane::triangles;
    material.bending = bending;
    material.stretch = 300;
    material.rigidity = rigidity;
    cloth = gathered();
    options.run.air_drag = 4;
    options.seconds = 1;
    options.calm_seconds = 1;
  }
  physics::Cloth gathered() const {
    physics::Cloth c = bridge::gather(mesh, material);
    std::vector<int> top;
    for (const geometry::Vertex v : mesh.vertices())
      if (mesh.point(v).y() > 0.2999) top.push_back(int(v));
    physics::pin(c.particles, top);
    bridge::couple_bending(mesh, material, c);
    return c;
  }
  bridge::KeepReport keep() { return bridge::keep_lines(mesh, cloth, {}, {}, options); }
  double residual(const physics::Cloth& c) const {
    return physics::residual_force(c, gravity, nullptr, 0, 0.003);
  }
};

constexpr bridge::Bending hinge = bridge::Bending::hinge, plate = bridge::Bending::plate;

}  // namespace

TEST_CASE("keep_lines: a ridge in cloth that can bear it stays as drawn, and after a gust", "[release]") {
  Hung hung(1e-4, {}, 1, 0.02, GENERATE(hinge, plate));
  const bridge::KeepReport report = hung.keep();
  REQUIRE(report.lines.size() == 1);
  CHECK(report.lines[0].verdict == Verdict::held);
  CHECK(report.lines[0].kept == Approx(1).margin(2e-3));
  CHECK(report.lines[0].kept_gust == Approx(1).margin(0.02));
  CHECK(report.certificate.stable());
  CHECK(report.drift < 5e-4);  // what is left of the push
  CHECK(report.trials == 1);
  CHECK(hung.residual(hung.cloth) < 1e-8);
  CHECK(hung.residual(hung.gathered()) > 1e-3);
}

TEST_CASE("keep_lines: a line starts from its own width and press, and help multiplies it", "[release]") {
  const bridge::Bending bending = GENERATE(hinge, plate);
  Hung stiff(1e-4, 0.08, 3, 0.02, bending), soft(1e-6, 0.08, 5, 0.02, bending);
  const bridge::KeepReport held = stiff.keep();
  CHECK(held.lines[0].verdict == Verdict::held);
  CHECK(held.lines[0].press == 3);
  CHECK(held.lines[0].height == Approx(0.012).epsilon(1e-3));
  CHECK(held.lines[0].kept == Approx(1).margin(0.01));
  soft.options.presses = {10};
  soft.options.struts.clear();
  soft.options.height_trials = 0;
  soft.options.seconds = soft.options.calm_seconds = 0.2;
  CHECK(soft.keep().lines[0].press == 50);
}

TEST_CASE(
    "keep_lines: a line with a width is the same fold on a coarse and on a fine mesh, and is kept on both",
    "[release]") {
  std::vector<bridge::KeptLine> lines;
  for (const double edge : {0.02, 0.01}) {
    Hung hung(1e-4, 0.06, 1, edge);
    hung.options.seconds = 0.3;
    hung.options.gust = 0;
    lines.push_back(hung.keep().lines[0]);
    CHECK(lines.back().verdict == Verdict::held);
    CHECK(lines.back().kept == Approx(1).margin(1e-3));
  }
  CHECK(lines[1].height == Approx(lines[0].height).epsilon(0.01));
}

TEST_CASE("keep_lines: with whole what lies between the lines is pressed until nothing in it gives way",
          "[release]") {
  const bridge::Bending bending = GENERATE(hinge, plate);
  Hung lines(3e-8, {}, 1, 0.02, bending), whole(3e-8, {}, 1, 0.02, bending);
  for (Hung* hung : {&lines, &whole}) {
    hung->options.seconds = hung->options.calm_seconds = 0.05;
    hung->options.height_trials = 0;
  }
  whole.options.whole = true;
  const bridge::KeepReport bare = lines.keep(), report = whole.keep();
  CHECK(bare.rest_press == 1);
  CHECK(report.rest_press > 1);
  CHECK(report.certificate.negative_eigenvalues >= 0);  // counted, though trials do not
  CHECK(report.certificate.negative_eigenvalues < bare.certificate.negative_eigenvalues);
}

TEST_CASE("keep_lines: what is stored on the mesh is gathered again as the same cloth at rest", "[long]") {
  Hung hung(1e-4, {}, 1, 0.02, GENERATE(hinge, plate));
  hung.keep();
  bridge::store_rest_state(hung.cloth, hung.material, hung.mesh);
  CHECK(hung.residual(hung.gathered()) < 1e-8);
}

TEST_CASE("keep_lines: a pressed plate is gathered again to the last bit, and holds in another run",
          "[release]") {
  Hung hung(3e-6, {}, 1, 0.02, plate);
  hung.options.whole = true;
  const bridge::KeepReport report = hung.keep();
  const bridge::KeptLine& line = report.lines[0];
  CAPTURE(line.press, line.struts, report.rest_press, line.reason);
  REQUIRE(bridge::holds(line.verdict));
  CHECK(line.press > 1);
  CHECK(report.rest.residual < 1e-8);
  bridge::store_rest_state(hung.cloth, hung.material, hung.mesh);
  physics::Cloth again = hung.gathered();
  REQUIRE(again.energies.size() == 1);
  const auto plate_in = [](const physics::Cloth& c) -> const physics::Plate& {
    return dynamic_cast<const physics::PlateBending&>(*c.energies[0]).plate();
  };
  CHECK(plate_in(again).share == plate_in(hung.cloth).share);
  CHECK(plate_in(again).stiffness == plate_in(hung.cloth).stiffness);
  CHECK(hung.residual(again) == report.rest.residual);
  bridge::LineMeter meter(hung.mesh, {}, hung.options.line_widths);
  const double told = meter.heights(again.particles)[0];
  for (std::size_t i = 0; i < again.particles.size(); ++i)  // another push than the verdict's
    if (again.particles.inv_mass[i] > 0) again.particles.x[i].z() += 1e-4 * std::sin(7.0 * double(i));
  physics::SimulateOptions run = hung.options.run;
  run.seconds = 2;
  run.dt_factor /= 2;
  run.air_drag /= 2;
  physics::simulate(again, physics::World{}, run);
  CHECK(meter.heights(again.particles)[0] / told == Approx(1).margin(0.05));
}

TEST_CASE("keep_lines: soft cloth needs help, and without it no line is called held", "[release]") {
  const bridge::Bending bending = GENERATE(hinge, plate);
  Hung alone(1e-6, {}, 1, 0.02, bending), helped(1e-6, {}, 1, 0.02, bending);
  alone.options.presses.clear();
  alone.options.struts.clear();
  alone.options.height_trials = 0;
  const bridge::KeepReport bare = alone.keep(), report = helped.keep();
  CHECK(bare.lines[0].verdict == Verdict::cannot_hold);
  CHECK_FALSE(bare.lines[0].reason.empty());
  CHECK(report.lines[0].press > 1);
  CHECK(report.trials > 1);
  if (bridge::holds(report.lines[0].verdict)) {
    CHECK(report.lines[0].kept >= 0.95);
    CHECK(report.lines[0].kept_gust >= 0.95);
  }
}

TEST_CASE("keep_lines: where no lower height holds either, what was found stands", "[release]") {
  Hung once(1e-8), lower(1e-8);
  for (Hung* hung : {&once, &lower}) {
    hung->options.seconds = hung->options.calm_seconds = 0.2;
    hung->options.presses.clear();
    hung->options.struts.clear();
    hung->options.height_trials = 0;
  }
  lower.options.height_trials = 3;
  const bridge::KeepReport found = once.keep(), tried = lower.keep();
  REQUIRE(found.lines[0].verdict == Verdict::cannot_hold);
  CHECK(tried.trials == found.trials + 3);
  CHECK(tried.lines[0].verdict == Verdict::cannot_hold);
  CHECK(tried.lines[0].lowered == 1);
  CHECK(tried.lines[0].reason == found.lines[0].reason);
  CHECK(tried.drift == found.drift);
  CHECK(lower.cloth.particles.x == once.cloth.particles.x);
}

namespace {

/// Motion alone judges, in a second, and nothing helps.
void try_bare(Hung& hung, double kept) {
  hung.options.presses.clear();
  hung.options.struts.clear();
  hung.options.height_trials = 0;
  hung.options.seconds = hung.options.calm_seconds = 1;
  hung.options.kept = kept;
}

}  // namespace

TEST_CASE("keep_lines: a line that keeps its height with little to spare may hold", "[release]") {
  const auto verdict = [](double kept) {
    Hung hung(1e-4);
    try_bare(hung, kept);
    return hung.keep().lines[0];
  };
  const bridge::KeptLine sure = verdict(0.1);
  CHECK(sure.verdict == Verdict::held);
  const double off = std::abs(sure.kept_gust - 1);
  CAPTURE(sure.kept, sure.kept_gust);
  REQUIRE(std::abs(sure.kept - 1) < off);
  const bridge::KeptLine line = verdict(1 - 1.2 * off);
  CHECK(line.kept_gust == sure.kept_gust);
  CHECK(line.verdict == Verdict::may_hold);
  CHECK_FALSE(bridge::holds(line.verdict));
  CHECK(line.reason.find("another") != std::string::npos);
  CHECK(verdict(1 - 0.8 * off).verdict == Verdict::may_hold);
}

TEST_CASE(
    "keep_lines: what gusts alone take may hold, is helped no further, and the report says what is left",
    "[release]") {
  const auto kept = [](double least) {
    Hung hung(1e-4);
    try_bare(hung, least);
    hung.options.presses = {10};
    hung.options.height_trials = 2;
    hung.options.gust = 17.26;  // m/s^2
    hung.options.run.integrator = physics::Integrator::implicit;
    return hung.keep();
  };
  const double off = std::abs(kept(0.1).lines[0].kept_gust - 1);
  const bridge::KeepReport report = kept(1 - 0.9 * off), nearly = kept(1 - 1.2 * off);
  for (const bridge::KeepReport& tried : {report, nearly}) {
    CHECK(tried.lines[0].verdict == Verdict::may_hold);
    CHECK(tried.lines[0].press == 1);
    CHECK(tried.lines[0].lowered == 1);
    CHECK(tried.trials == 1);
    CHECK(tried.runs == 1);
    CHECK(std::abs(tried.lines[0].kept_gust - 1) == off);
  }
  CHECK_THAT(report.lines[0].reason, Catch::Contains("nothing blows") && Catch::Contains("gusts left it at"));
  CHECK_THAT(nearly.lines[0].reason, Catch::Contains("another may end farther off"));
}

TEST_CASE("try_statics: a ridge in stiff cloth keeps its height, one that is turned over does not",
          "[release]") {
  Hung hung(1e-4);
  physics::prestress(hung.cloth);
  bridge::LineMeter meter(hung.mesh, {}, hung.options.line_widths);
  physics::StiffnessWork work;
  const auto search = [&](const std::function<bool()>& go_on) {
    return bridge::try_statics(hung.cloth, {}, hung.options, meter, work, go_on);
  };
  const bridge::StaticTrial rests = search({});
  CHECK(rests.kept[0] == Approx(1).margin(5e-3));
  CHECK(rests.drift > 0);
  hung.options.run.gravity = {0, 9.81, 0};  // that is far
  CHECK(search({}).kept[0] != Approx(1).margin(5e-3));
  CHECK(search([] { return false; }).stopped);
}

TEST_CASE("keep_lines: wherever it is cancelled, no line is called held that motion did not try", "[long]") {
  int tries = 0, cancelled = 0, interrupted = 0;
  for (int last = 0; last < 20000; last += 8 + last / 4) {
    ++tries;
    Hung hung(1e-4);
    hung.options.seconds = hung.options.calm_seconds = hung.options.gust_seconds = 0.02;
    hung.options.presses = {10};
    hung.options.struts.clear();
    hung.options.whole = true;  // what needs help beside the line
    int asked = 0;
    const physics::CancelScope cancelling([&] { return ++asked > last; });
    try {
      const bridge::KeepReport report = hung.keep();
      interrupted += report.interrupted;
      if (!report.interrupted || report.runs > 0) continue;
      CAPTURE(last, report.lines[0].kept, report.lines[0].kept_gust);
      CHECK(report.lines[0].verdict == Verdict::not_known);
    } catch (const physics::Cancelled&) {
      ++cancelled;
    }
  }
  CHECK(interrupted > 0);
  CHECK(cancelled + interrupted < tries);
}

TEST_CASE("keep_lines: a garment that nothing holds is said to be out of balance", "[long]") {
  Hung hung(1e-4);
  hung.cloth = bridge::gather(hung.mesh, hung.material);
  hung.options.seconds = 0.05;
  hung.options.gust = 0;
  const bridge::KeepReport report = hung.keep();
  CHECK_FALSE(report.rest.imbalance.empty());
  CHECK(report.lines[0].verdict == Verdict::cannot_hold);
  CHECK(report.lines[0].reason.find("balance") != std::string::npos);
  CHECK(report.runs == 0);  // it would fall as it is
  CHECK(std::isnan(report.lines[0].kept));
  CHECK(std::isnan(report.lines[0].kept_gust));
}

TEST_CASE(
    "keep_lines: a ridge in cloth that lies on a ball holds, and a valley is as deep as the ball allows",
    "[release]") {
  struct Ball : physics::Collider {
    physics::SignedDistance at(const physics::Vec3& x) const override {
      return {x.norm() - 0.2, x.normalized()};
    }
  } ball;
  geometry::Mesh mesh = geometry::equilateral_sheet(0.3, 0.3, 0.02);
  for (const geometry::Vertex v : mesh.vertices()) {  // laid onto it, outside up
    const physics::Vec3 flat(mesh.point(v).x(), 0, 0.15 - mesh.point(v).y());
    const double angle = flat.norm() / 0.2;
    const physics::Vec3 x =
        0.203 * (std::sin(angle) * flat.stableNormalized() + std::cos(angle) * physics::Vec3::UnitY());
    mesh.point(v) = {x.x(), x.y(), x.z()};
  }
  std::vector<geometry::Stroke> lines(2);
  for (const int side : {0, 1}) {
    const double x = side ? 0.07 : -0.07, y = std::sqrt(0.203 * 0.203 - x * x - 0.05 * 0.05);
    lines[side].height = side ? 0.01 : -0.01;
    lines[side].points = {{x, y, -0.05}, {x, y, 0.05}};
  }
  const geometry::WrinkleReport report = geometry::wrinkle(mesh, lines, furrow::tests::safe_rule());
  Hung hung(1e-4);
  hung.mesh = mesh;
  hung.material.mean_structural_length = report.mean_structural_length;
  hung.cloth = bridge::gather(mesh, hung.material);
  hung.options.gust = 3;
  physics::World world;
  world.collider = &ball;
  const double drawn_valley = report.lines[0].smoothed_height;
  const bridge::KeepReport kept = bridge::keep_lines(
      hung.mesh, hung.cloth, world, {report.lines[0].base_height, report.lines[1].base_height}, hung.options);
  REQUIRE(kept.lines.size() == 2);
  CHECK(kept.certificate.residual < 1e-8);
  CHECK(kept.rest.imbalance.empty());
  CHECK(kept.rest.touching.size() > 20);
  CHECK(kept.pushed_out > 5);
  CHECK(kept.farthest_push < 0.01);
  CHECK(std::abs(kept.lines[0].height) < 0.5 * std::abs(drawn_valley));
  CHECK(kept.lines[1].verdict == Verdict::held);
  for (const physics::Vec3& x : hung.cloth.particles.x)
    CHECK(x.norm() > 0.2 + hung.options.run.contact_gap - 1e-8);
}

TEST_CASE("keep_lines: a shape that stands like a pencil on its tip is pushed before it is believed",
          "[release]") {
  Hung standing(1e-3);
  physics::Cloth cloth = bridge::gather(standing.mesh, standing.material);
  std::vector<int> bottom;
  for (const geometry::Vertex v : standing.mesh.vertices())
    if (standing.mesh.point(v).y() < 1e-4) bottom.push_back(int(v));
  physics::pin(cloth.particles, bottom);
  physics::balance_rigidly(cloth, -gravity);
  REQUIRE(physics::prestress(cloth).residual < 1e-8);
  REQUIRE_FALSE(physics::certify(cloth).stable());
  standing.options.gust = 0;
  standing.options.seconds = 1;
  bridge::LineMeter meter(standing.mesh, {}, {});
  const auto drift = [&](bool stable) {
    return bridge::try_shape(cloth, stable, {}, standing.options, meter, {}, {}).drift;
  };
  CHECK(drift(true) > 1e-3);  // whatever the certificate said
  CHECK(drift(false) > 1e-3);
}

TEST_CASE("keep_lines: lines drawn at random on coarse meshes and called held are held in another run, too",
          "[release]") {
  int held = 0;
  for (const std::uint64_t seed : {20261125, 20261127, 20261132}) {
    CAPTURE(seed);
    cases::RandomGarment garment = cases::random_garment(seed, 4, 0.04);
    physics::Cloth cloth = garment.cloth();
    KeepOptions options;
    options.seconds = options.calm_seconds = 1;
    options.gust = 2;
    options.presses = {100};
    options.struts = {3};
    options.height_trials = 0;
    const bridge::KeepReport report = bridge::keep_lines(garment.mesh, cloth, {}, garment.base(), options);
    const std::vector<double> left = cases::heights_after(garment, cloth, options.run, seed);
    for (const bridge::KeptLine& line : report.lines) {
      if (!bridge::holds(line.verdict)) continue;
      ++held;
      CAPTURE(line.line, line.press, line.struts, line.kept, line.kept_gust);
      CHECK(left[line.line] / line.height == Approx(1).margin(0.05));
    }
  }
  CHECK(held >= 6);
}

TEST_CASE("keep_lines: a line that lies across others which are lowered is told as it lies", "[release]") {
  cases::RandomGarment garment = cases::random_garment(20261143, 3);
  garment.springs.bending = bridge::Bending::plate;
  const std::vector<double> drawn = cases::heights_of(garment);
  physics::Cloth cloth = garment.cloth();
  KeepOptions options;
  options.seconds = 2;
  options.run.integrator = physics::Integrator::implicit;
  const bridge::KeepReport report = bridge::keep_lines(garment.mesh, cloth, {}, garment.base(), options);
  const std::vector<double> lie = cases::heights_of(garment);
  for (const bridge::KeptLine& line : report.lines) {
    CAPTURE(line.line, line.kept);
    if (line.verdict <= Verdict::lowered) CHECK((line.verdict == Verdict::lowered) == (line.lowered < 0.95));
    CHECK(line.height == Approx(lie[line.line]));
    CHECK(line.lowered == Approx(lie[line.line] / drawn[line.line]));
  }
}

TEST_CASE("keep_lines: a trial asks once on its way, and what ends there is not known") {
  Hung hung(1e-4);
  hung.options.seconds = hung.options.calm_seconds = 0.1;
  hung.options.gust_seconds = 0.05;
  hung.options.run.integrator = physics::Integrator::implicit;
  bridge::LineMeter meter(hung.mesh, {}, {});
  const auto trial = [&](bool ends) {
    int asked = 0;
    const bridge::KeepTrial result = bridge::try_shape(hung.cloth, true, {}, hung.options, meter,
                                                       [&](const auto&) { return ++asked > 0 && ends; }, {});
    CHECK(asked == 1);
    return result;
  };
  const bridge::KeepTrial early = trial(true), whole = trial(false);
  CHECK(std::isfinite(early.kept.at(0)));
  CHECK(std::isnan(early.kept_gust.at(0)));
  CHECK(std::isfinite(whole.kept.at(0)));
  CHECK(std::isfinite(whole.kept_gust.at(0)));
  hung.options.gust = 0;
  const bridge::KeepTrial calm = trial(false);
  CHECK(calm.kept == whole.kept);
  CHECK(calm.kept_gust == calm.kept);
}

TEST_CASE("try_shape: calm ends once nothing moves, but not that of a shape that is not stable") {
  Hung hung(1e-4);
  hung.options.seconds = 5;
  hung.options.gust = 0;
  hung.options.run.integrator = physics::Integrator::implicit;
  REQUIRE(hung.keep().certificate.stable());
  bridge::LineMeter meter(hung.mesh, {}, {});
  const auto seen = [&](bool stable) {
    double farthest = 0;
    bridge::try_shape(hung.cloth, stable, {}, hung.options, meter, {}, [&](double share) {
      farthest = std::max(farthest, share);
      return true;
    });
    return farthest;
  };
  CHECK(seen(true) < 0.5);
  CHECK(seen(false) == Approx(1));
}

TEST_CASE("keep_lines: a line of 0.01 mm is refused before anything is tried, and told what to do") {
  Hung hung(1e-4, {}, 1, 0.02, bridge::Bending::hinge, 1e-5);
  const bridge::KeepReport report = hung.keep();
  REQUIRE(report.lines.size() == 1);
  CHECK(report.lines[0].verdict == Verdict::cannot_hold);
  CHECK(std::isnan(report.lines[0].kept));
  CHECK_THAT(report.lines[0].reason, Catch::Contains("0.1 mm") && Catch::Contains("draw it higher"));
  CHECK(report.trials == 1);
  CHECK(report.runs == 0);
  hung.options.least_height = -1;
  CHECK_THROWS_WITH(hung.keep(), Catch::Contains("least_height"));
}

TEST_CASE("keep_lines: a line whose height cannot be measured is told, and not held") {
  Hung hung(1e-4);
  hung.mesh = geometry::equilateral_sheet(0.3, 0.3, 0.02);
  geometry::Stroke hem;
  hem.height = 0.01;
  hem.width = 0.08;
  hem.points = {{-0.149, 0.03, 0}, {0.149, 0.03, 0}};
  geometry::wrinkle(hung.mesh, std::span(&hem, 1), furrow::tests::safe_rule());
  hung.cloth = hung.gathered();
  hung.options.line_widths = {0.08};
  hung.options.seconds = 0.1;
  hung.options.gust = 0;
  const bridge::KeepReport report = hung.keep();
  REQUIRE(report.lines.size() == 1);
  CHECK(report.lines[0].verdict == Verdict::cannot_hold);
  CHECK_THAT(report.lines[0].reason, Catch::Contains("measured"));
}

TEST_CASE("keep_lines: keep refuses options out of range, and changes nothing") {
  Hung hung(1e-4);
  const double before = hung.cloth.hinges[0].rest_angle;
  hung.options.kept = 1.5;
  CHECK_THROWS_WITH(hung.keep(), Catch::Contains("kept = 1.5"));
  hung.options.kept = 0.95;
  hung.options.push = 0;
  CHECK_THROWS_WITH(hung.keep(), Catch::Contains("push = 0"));
  hung.options.push = 5e-4;
  hung.options.presses = {10, 5};
  CHECK_THROWS_WITH(hung.keep(), Catch::Contains("presses"));
  CHECK(hung.cloth.hinges[0].rest_angle == before);
}
