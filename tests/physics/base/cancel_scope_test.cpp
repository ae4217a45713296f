// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/base/cancel_scope.h"

#include <catch2/catch.hpp>
#include <thread>

#include "physics/base/progress.h"

using namespace furrow::physics;

TEST_CASE("cancel_scope: it counts while it lives, the innermost one first, and in its own thread alone") {
  CHECK_FALSE(is_cancelled());
  int asked = 0;
  {
    const CancelScope outer([&] { return ++asked > 0; });
    CHECK(is_cancelled());
    {
      const CancelScope inner([] { return false; });
      CHECK_FALSE(is_cancelled());
      CHECK_NOTHROW(throw_if_cancelled("the test"));
    }
    CHECK_THROWS_AS(throw_if_cancelled("the test"), Cancelled);
    CHECK_THROWS_WITH(throw_if_cancelled("the test"), "the test: cancelled");
    CHECK(asked == 3);
    bool beside = true;
    std::thread([&] { beside = is_cancelled(); }).join();
    CHECK_FALSE(beside);
    CHECK(asked == 3);
  }
  CHECK_FALSE(is_cancelled());
  CHECK(asked == 3);
}
