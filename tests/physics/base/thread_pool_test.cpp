// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/base/thread_pool.h"

#include <catch2/catch.hpp>
#include <numeric>
#include <stdexcept>

using furrow::physics::ThreadPool;

TEST_CASE("thread_pool: a thread pool covers the range once, round after round") {
  ThreadPool pool(GENERATE(1, 2, 3, 5));
  for (const int n : {0, 1, 2, 4, 1000}) {
    std::vector<int> touched(std::size_t(n), 0);
    for (int round = 0; round < 50; ++round) {
      pool.run(n, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) ++touched[std::size_t(i)];
      });
    }
    CHECK(std::accumulate(touched.begin(), touched.end(), 0) == 50 * n);
    CHECK(std::all_of(touched.begin(), touched.end(), [](int t) { return t == 50; }));
  }
}

TEST_CASE("thread_pool: an exception of a chunk reaches the caller and the pool lives on") {
  ThreadPool pool(3);
  const auto fail = [](int begin, int) {
    if (begin > 0) throw std::runtime_error("chunk at " + std::to_string(begin));
  };
  CHECK_THROWS_WITH(pool.run(9, fail), "chunk at 3");
  int sum = 0;
  pool.run(1, [&](int, int end) { sum += end; });
  CHECK(sum == 1);
  CHECK_THROWS_AS(ThreadPool(0), std::invalid_argument);
}

TEST_CASE("thread_pool: every piece is done once, whoever takes it") {
  for (const int threads : {1, 2, 5}) {
    ThreadPool pool(threads);
    std::vector<int> done(100, 0);
    pool.share(100, [&](int i, int thread) {
      if (thread >= 0 && thread < threads) ++done[std::size_t(i)];
    });
    CHECK(done == std::vector<int>(100, 1));
    pool.share(0, [&](int, int) { FAIL("there is nothing to do"); });
    CHECK_THROWS_AS(pool.share(3, [](int, int) { throw std::runtime_error("no"); }), std::runtime_error);
  }
}
