// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace furrow::bench {

/// CPU seconds of this thread, which are meaningful on a busy machine, too.
double cpu_seconds();

/// STREAM triad a = b + s c over arrays far larger than the caches [GB/s of CPU time], median of 7.
double stream_triad();

/// Plain spring forces and a leapfrog step of a sheet of 129 x 129 vertices (structural and shear springs,
/// float, each spring stored at both ends) [million vertex steps a CPU second], median of 7.
double plain_springs();

}  // namespace furrow::bench
