// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/machine_probes.h"

#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace furrow::bench {
namespace {

template <class F>
double median_seconds(F run) {
  std::array<double, 7> seconds;
  for (double& s : seconds) {
    const double start = cpu_seconds();
    run();
    s = cpu_seconds() - start;
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds[3];
}

using Floats = std::vector<float>;

/// A square sheet; neighbours lie slot-major, a missing one is the vertex itself with stiffness 0.
struct Sheet {
  static constexpr int side = 129, count = side * side, slots = 8;
  std::array<Floats, 3> x, v, next;
  std::vector<int> other;
  Floats rest, stiffness;

  Sheet() : other(slots * count), rest(slots * count, 1), stiffness(slots * count, 0) {
    for (int k = 0; k < 3; ++k) x[k] = v[k] = next[k] = Floats(count, 0);
    constexpr int di[] = {1, -1, 0, 0, 1, 1, -1, -1}, dj[] = {0, 0, 1, -1, 1, -1, 1, -1};
    const float h = 1.0f / (side - 1);
    for (int n = 0; n < count; ++n) {
      const int i = n % side, j = n / side;
      x[0][n] = h * i;
      x[1][n] = h * j;
      for (int s = 0; s < slots; ++s) {
        const int a = i + di[s], b = j + dj[s], at = s * count + n;
        const bool there = a >= 0 && b >= 0 && a < side && b < side;
        other[at] = there ? b * side + a : n;
        if (there)
          rest[at] = h * std::sqrt(static_cast<float>(di[s] * di[s] + dj[s] * dj[s])), stiffness[at] = 100;
      }
    }
  }

  void step(float dt, float inverse_mass) {
    for (int n = 0; n < count; ++n) {
      float f[3] = {0, 0, 0};
      for (int s = 0; s < slots; ++s) {
        const int at = s * count + n, m = other[at];
        const float d[3] = {x[0][m] - x[0][n], x[1][m] - x[1][n], x[2][m] - x[2][n]};
        const float length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + 1e-20f);
        const float pull = stiffness[at] * (1 - rest[at] / length);
        for (int k = 0; k < 3; ++k) f[k] += pull * d[k];
      }
      f[1] -= 9.81f / inverse_mass;
      for (int k = 0; k < 3; ++k) {
        v[k][n] += dt * inverse_mass * f[k];
        next[k][n] = x[k][n] + dt * v[k][n];
      }
    }
    x.swap(next);
  }
};

}  // namespace

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double stream_triad() {
  const std::size_t n = 8'000'000;
  std::vector<double> a(n, 1), b(n, 2), c(n, 3);
  double s = 1;
  const double seconds = median_seconds([&] {
    s += 1;
    for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + s * c[i];
    asm volatile("" ::"r"(a.data()) : "memory");
  });
  return 24e-9 * static_cast<double>(n) / seconds;
}

double plain_springs() {
  Sheet sheet;
  constexpr int steps = 40;
  const double seconds = median_seconds([&] {
    for (int i = 0; i < steps; ++i) sheet.step(1e-5f, Sheet::count / 0.2f);
    asm volatile("" ::"r"(sheet.x[0].data()) : "memory");
  });
  return 1e-6 * steps * Sheet::count / seconds;
}

}  // namespace furrow::bench
