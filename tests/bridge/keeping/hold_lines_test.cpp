// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/keeping/hold_lines.h"

#include <catch2/catch.hpp>
#include <vector>

#include "bridge/arrays/gather.h"
#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/sheet.h"
#include "physics/cloth/pins.h"
#include "physics/contact/residual_force.h"
#include "tests/cases/safe_rule.h"

using namespace furrow;

namespace {

/// A sheet with a level ridge; it hangs by its upper edge, or falls.
struct Ridge {
  geometry::Mesh mesh = geometry::equilateral_sheet(0.3, 0.3, 0.02);
  bridge::GatherOptions material;
  bridge::KeepOptions options;
  bool pinned;

  explicit Ridge(double rigidity, bool is_pinned = true) : pinned(is_pinned) {
    geometry::Stroke ridge;
    ridge.height = 0.012;
    ridge.points = {{-0.08, 0.2, 0}, {0.08, 0.2, 0}};
    const auto report = geometry::wrinkle(mesh, std::span(&ridge, 1), furrow::tests::safe_rule());
    material.mean_structural_length = report.mean_structural_length;
    material.mean_bending_length = report.mean_bending_length;
    material.membrane = bridge::Membrane::triangles;
    material.bending = bridge::Bending::hinge;
    material.stretch = 300;
    material.rigidity = rigidity;
  }
  bridge::HeldLines hold(double press = 1) {
    options.line_presses = {press};
    const auto make = [&](const std::vector<double>& presses) {
      material.line_presses = presses;
      physics::Cloth cloth = bridge::gather(mesh, material);
      std::vector<int> top;
      for (const geometry::Vertex v : mesh.vertices())
        if (pinned && mesh.point(v).y() > 0.2999) top.push_back(int(v));
      physics::pin(cloth.particles, top);
      return cloth;
    };
    return bridge::hold_lines(mesh, make, options);
  }
};

}  // namespace

TEST_CASE("hold_lines: a ridge in cloth that can bear it is not pressed, and balances as drawn") {
  const bridge::HeldLines held = Ridge(1e-4).hold();
  CHECK(held.presses == std::vector<double>{1});
  CHECK(held.shape.certificate.stable());
  CHECK(physics::residual_force(held.cloth, {0, -9.81, 0}, nullptr, 0, 0.003) < 1e-6);
}

TEST_CASE("hold_lines: soft cloth gets a press, and without it the ridge gives way") {
  const bridge::HeldLines held = Ridge(5e-7).hold();
  CHECK(held.presses.at(0) > 1);
  Ridge without(5e-7);
  without.options.presses.clear();
  CHECK_FALSE(without.hold().shape.certificate.stable());
  CHECK(physics::fingerprint(Ridge(5e-7).hold().cloth) == physics::fingerprint(held.cloth));
}

TEST_CASE("hold_lines: a line keeps the press that it has, and gets none beyond the strongest") {
  CHECK(Ridge(1e-4).hold(20).presses[0] == 20);
  CHECK(Ridge(1e-8).hold(40).presses[0] == 100);
  CHECK(Ridge(1e-8).hold(400).presses[0] == 400);
}

TEST_CASE("hold_lines: what nothing carries as it lies gets the first press") {
  CHECK(Ridge(1e-4, false).hold().presses[0] == 10);
  CHECK(Ridge(1e-4, false).hold(20).presses[0] == 20);
  Ridge flat(1e-4, false);
  flat.options.flat_lines = {1};
  CHECK(flat.hold().presses[0] == 1);
}
