// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/fabric.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/mesh/errors.h"
#include "io/scene/fabrics.h"
#include "physics/cloth/membrane.h"
#include "tests/jobs/recorder.h"

using namespace furrow;

namespace {

jobs::DiscJob disc_of(const char* fabric, int rings) {
  jobs::DiscJob job;
  job.material = jobs::material_of_settings({{"preset", fabric}});
  job.rings = rings;
  return job;
}

}  // namespace

TEST_CASE("drape_disc: a board stays flat, and a limp cloth falls to a fraction", "[release]") {
  tests::Recorder recorder;
  jobs::DiscJob job = disc_of("cotton", 10);
  job.material.rigidity = 1;
  CHECK(jobs::drape_disc(job, recorder).coefficient == Approx(1).margin(0.004));  // of 63 corners
  job.material.rigidity = 1e-7;
  const jobs::DiscReport limp = jobs::drape_disc(job, recorder);
  CHECK(limp.rested > 0);
  CHECK(limp.coefficient < 0.3);
  CHECK(limp.least <= limp.coefficient);
  CHECK(limp.coefficient <= limp.most);
  CHECK(limp.energy < 0);
}

TEST_CASE("drape_disc: a finer mesh drapes as much", "[release]") {
  tests::Recorder recorder;
  const double coarse = jobs::drape_disc(disc_of("black-denim", 15), recorder).coefficient;
  const double fine = jobs::drape_disc(disc_of("black-denim", 30), recorder).coefficient;
  INFO(coarse << " and " << fine);
  CHECK(std::abs(fine - coarse) < 0.02);
}

TEST_CASE("drape_disc: friction of bending holds a disc up, by hinges and by a plate", "[release]") {
  tests::Recorder recorder;
  for (const char* fabric : {"cotton", "wool-twill"}) {
    jobs::DiscJob job = disc_of(fabric, 15);
    if (std::string(fabric) == "cotton") job.material.bending_law = bridge::Bending::hinge;
    const double elastic = jobs::drape_disc(job, recorder).coefficient;
    job.bending_friction = 30 * job.material.rigidity;
    const jobs::DiscReport held = jobs::drape_disc(job, recorder);
    CAPTURE(fabric, elastic, held.coefficient);
    CHECK(held.rested == held.starts);
    CHECK(held.coefficient > elastic + 0.01);
    CHECK(held.coefficient < 1);
  }
  jobs::DiscJob job = disc_of("cotton", 10);
  job.bending_friction = -1;
  CHECK_THROWS_WITH(jobs::drape_disc(job, recorder), Catch::StartsWith("`bending_friction`"));
}

TEST_CASE("drape_disc: what does not fit is refused, and it can be cancelled") {
  tests::Recorder recorder, impatient(3);
  CHECK_THROWS_WITH(jobs::drape_disc(disc_of("cotton", 12), recorder),
                    Catch::StartsWith("`rings`: 12 does not fit"));
  jobs::DiscJob job = disc_of("cotton", 10);
  job.folds.clear();
  CHECK_THROWS_AS(jobs::drape_disc(job, recorder), std::invalid_argument);
  CHECK_THROWS(jobs::drape_disc(disc_of("cotton", 10), impatient));
}

TEST_CASE("pull_swatch: at a small strain it pulls as a strip cut at that angle does") {
  const io::SceneMaterial m = jobs::material_of_settings({{"preset", "polyester-twill"}});
  for (const double angle : {0., 90.}) {
    const jobs::SwatchReport s = jobs::pull_swatch(m, angle, 1e-3);
    INFO("angle " << angle << ", modulus " << s.modulus << ", of a long strip " << s.wanted);
    CHECK(s.rested);
    CHECK(s.modulus == Approx(s.wanted).epsilon(0.02));
  }
  // On the bias the clamped ends hold the cloth from shearing: stiffer, but far from the threads.
  const jobs::SwatchReport bias = jobs::pull_swatch(m, 45, 1e-3);
  CHECK(bias.modulus > bias.wanted);
  CHECK(bias.modulus < 2 * bias.wanted);
  CHECK(bias.modulus < 0.6 * *m.warp_stretch);
}

TEST_CASE("fit_rigidity: it finds a rigidity that drapes as it was measured, or says that none does",
          "[release]") {
  tests::Recorder recorder;
  const jobs::DiscJob stiff = disc_of("red-jet-set", 10);
  const jobs::RigidityFit fit = jobs::fit_rigidity(stiff, 0.5, recorder);
  CHECK(fit.coefficient == Approx(0.5).margin(0.03));
  CHECK(fit.factor < 1);
  CHECK(*fit.material.warp_rigidity == Approx(fit.factor * *stiff.material.warp_rigidity));
  CHECK(*fit.material.warp_stretch == *stiff.material.warp_stretch);
  jobs::DiscJob again = stiff;
  again.material = fit.material;
  CHECK(jobs::drape_disc(again, recorder).coefficient == fit.coefficient);
  CHECK_THROWS_WITH(jobs::fit_rigidity(stiff, 0.01, recorder),
                    Catch::StartsWith("`drape`: no rigidity drapes so"));
}

TEST_CASE("fabric_from_table: KES and FAST figures in SI units, and what is missing by its name") {
  const auto made = [](const std::string& text) {
    return jobs::fabric_from_table(io::parse_toml(text, "t.toml"));
  };
  const jobs::Json kes =
      made("[kes]\nW = 15\nEMT_warp = 4\nEMT_weft = 8\nG = 0.8\nB_warp = 0.1\nB_weft = 0.05\n");
  CHECK(kes["thread_shear"].get<double>() == Approx(0.8 * 0.980665 * 57.29578).epsilon(1e-6));
  // Without a figure of its own, the bias is that of a sheet with B_t = sqrt(B1 B2) / 2.
  const double warp = kes["warp_rigidity"], weft = kes["weft_rigidity"];
  CHECK(kes["bias_rigidity"].get<double>() == Approx(4 / (2 / std::sqrt(warp * weft) + 1 / warp + 1 / weft)));
  CHECK_THROWS_WITH(made("[kes]\nW = 15\n"), Catch::Contains("kes.EMT_warp is missing"));
  CHECK_THROWS_WITH(made("[kes]\nW = -1\n"), Catch::Contains("kes.W is missing or not above 0"));
  CHECK_THROWS_WITH(made("W = 1\n"), Catch::Contains("either [kes] or [fast]"));
  CHECK_THROWS_WITH(made("kes = 3\n"), Catch::Contains("kes"));
}

TEST_CASE("fabrics: each of them is a material, and the means lie between warp and weft") {
  for (const io::Fabric& f : io::fabrics()) {
    INFO(f.name);
    const io::SceneMaterial m = jobs::material_of_settings({{"preset", f.name}});
    CHECK(m.is_woven() == f.threads.any());
    if (!f.threads.any()) continue;
    const auto& t = f.threads;
    CHECK_NOTHROW(physics::woven_sheet({t.warp, t.weft, t.shear, t.poisson}));
    CHECK(f.stretch >= 0.999 * std::min(t.warp, t.weft));
    CHECK(f.stretch <= 1.001 * std::max(t.warp, t.weft));
    CHECK(f.rigidity >= 0.999 * std::min({t.bend_warp, t.bend_bias, t.bend_weft}));
    CHECK(f.rigidity <= 1.001 * std::max({t.bend_warp, t.bend_bias, t.bend_weft}));
    CHECK_FALSE(jobs::material_of_settings({{"preset", f.name}, {"warp", "none"}}).is_woven());
  }
}
