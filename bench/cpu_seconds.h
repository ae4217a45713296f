// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <time.h>

namespace furrow::bench {

/// CPU seconds of this thread, which are meaningful on a busy machine, too.
inline double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

}  // namespace furrow::bench
