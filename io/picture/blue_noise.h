// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace furrow::io {

/// Blue noise: a number in [0, 1) for each pixel, of which neighbours differ as much as they can, so that
/// what a pixel's few rays miss shows as fine grain that the eye, or a box filter, averages away. A tile of
/// 64 × 64 is repeated, in which every k / 4096 stands once; it is found on the first call (some 20 ms), each
/// next rank in the largest void (after Ulichney 1993), and is the same on every machine.
double blue_noise(int column, int row);

}  // namespace furrow::io
