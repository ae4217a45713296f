// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "jobs/draw/shown_mesh.h"

namespace furrow::studio {

enum class ShownAs : std::uint32_t {
  cloth = 0,
  body = 1,
  preview = 2,
  moving = 3,
  colours = 4,
  moving_body = 5
};

/// A mesh as the page reads it (page/src/frame.ts), little-endian: the numbers 0x57525546, what it is, how
/// many vertices, faces, line edges and pinned vertices; then positions, undrawn positions (float32), faces,
/// edges (from, to, line) and pinned vertices (32 bits each).
std::string frame_bytes(ShownAs kind, const jobs::ShownMesh& mesh);

/// Whether bytes from anywhere are such a mesh of cloth: its numbers agree with its length, and faces, edges
/// and pins name vertices that there are.
bool is_frame(const std::string& bytes);

/// Positions of the cloth or body that was shown last [m], by its vertices' indices: the number 0x57525546,
/// the kind, how many vertices, and the time [ms]; then positions (float32).
std::string moving_bytes(double time, const std::vector<float>& positions, ShownAs kind = ShownAs::moving);

/// Colours of the cloth that was shown last: the number 0x57525546, "colours", how many vertices, 0; then
/// red, green and blue of each, a byte each.
std::string colour_bytes(const std::vector<std::uint8_t>& colours);

/// The same bytes as another kind.
std::string as_kind(std::string bytes, ShownAs kind);

}  // namespace furrow::studio
