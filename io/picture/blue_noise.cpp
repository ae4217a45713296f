// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/blue_noise.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace furrow::io {
namespace {

constexpr int tile_side = 64, tile_size = tile_side * tile_side;
constexpr int void_reach = 9;           // [pixels]: beyond it the weight of a pixel is below 1e-7
constexpr double void_deviation = 1.6;  // [pixels]: of the bell curve by which a pixel fills its surroundings

/// Where a rank may stand at first is free: a fixed scramble below any sum of weights.
double scramble(std::uint32_t h) {
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  return 1e-9 * 0x1p-32 * (h ^ (h >> 16));
}

using Weights = std::array<double, (2 * void_reach + 1) * (2 * void_reach + 1)>;

Weights bell() {
  Weights weights;
  int at = 0;
  for (int j = -void_reach; j <= void_reach; ++j)
    for (int i = -void_reach; i <= void_reach; ++i)
      weights[at++] = std::exp(-(i * i + j * j) / (2 * void_deviation * void_deviation));
  return weights;
}

std::vector<float> noise_tile() {
  const Weights weights = bell();
  std::vector<double> filled(tile_size);
  for (int i = 0; i < tile_size; ++i) filled[i] = scramble(std::uint32_t(i + 1));
  std::vector<float> tile(tile_size);
  for (int rank = 0; rank < tile_size; ++rank) {
    int emptiest = 0;
    for (int i = 1; i < tile_size; ++i)
      if (filled[i] < filled[emptiest]) emptiest = i;
    tile[emptiest] = float(rank) / tile_size;
    const int column = emptiest % tile_side, row = emptiest / tile_side;
    int at = 0;
    for (int j = -void_reach; j <= void_reach; ++j)
      for (int i = -void_reach; i <= void_reach; ++i)
        filled[(row + j + tile_side) % tile_side * tile_side + (column + i + tile_side) % tile_side] +=
            weights[at++];
    filled[emptiest] = std::numeric_limits<double>::infinity();
  }
  return tile;
}

}  // namespace

double blue_noise(int column, int row) {
  static const std::vector<float> tile = noise_tile();
  return tile[unsigned(row) % tile_side * tile_side + unsigned(column) % tile_side];
}

}  // namespace furrow::io
