// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow::tests;

TEST_CASE("hostile files: every hostile file is read or refused, without a signal", "[long]") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  int files = 0, read = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(shared_dir() / "meshes" / "hostile")) {
    if (!entry.is_regular_file()) continue;
    const Run run = run_furrow("info --json '" + entry.path().string() + "'");
    INFO(entry.path() << ": exit " << run.exit_code << " " << run.err);
    CHECK((run.exit_code == 0 || run.exit_code == 3));
    if (run.exit_code == 3) CHECK(run.err.rfind("error: ", 0) == 0);
    ++files;
    read += run.exit_code == 0;
  }
  CHECK(files >= 60);
  CHECK(read >= 20);
}
