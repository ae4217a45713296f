// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <stdexcept>

#include "tests/jobs/recorder.h"

using namespace furrow;

TEST_CASE("listener: a stretch of work tells its end, also where it is broken off") {
  tests::Recorder recorder;
  CHECK_THROWS_AS(
      [&] {
        const jobs::ProgressScope progress(recorder, "stitching");
        CHECK(progress(0.25));
        throw std::runtime_error("torn");
      }(),
      std::runtime_error);
  REQUIRE(recorder.told.size() == 2);
  CHECK(recorder.told[0] == std::pair<std::string, double>("stitching", 0.25));
  CHECK(recorder.told[1] == std::pair<std::string, double>("stitching", 1.0));
}

TEST_CASE("listener: a share never falls, also where a search begins again") {
  tests::Recorder recorder;
  const jobs::ProgressScope progress(recorder, "stitching");
  for (const double share : {0.1, 0.5, 0.2, 0.6}) progress(share);
  REQUIRE(recorder.told.size() == 4);
  CHECK(recorder.told[2].second == 0.5);
  CHECK(recorder.told[3].second == 0.6);
}

TEST_CASE("listener: a stretch of work is not to go on once the listener cancels") {
  tests::Recorder recorder(3);
  const jobs::ProgressScope progress(recorder, "stitching");
  CHECK(progress(0.1));
  CHECK(progress(0.2));
  CHECK_FALSE(progress(0.3));
}

TEST_CASE("listener: a silent one passes on that the other cancels, and nothing else") {
  tests::Recorder recorder(2);
  jobs::SilentListener silent(recorder);
  silent.warn({"code", "text", "", ""});
  silent.progress("stitching", 0.5);
  CHECK_FALSE(silent.cancelled());
  CHECK(silent.cancelled());
  CHECK(recorder.told.empty());
  CHECK(recorder.warnings.empty());
}
