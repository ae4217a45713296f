// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/frame_bytes.h"

#include <bit>
#include <cmath>
#include <cstring>

namespace furrow::studio {
namespace {

static_assert(std::endian::native == std::endian::little, "frames are written as they lie in memory");

template <class T>
void add_list(std::string& bytes, const std::vector<T>& list) {
  bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
}

}  // namespace

std::string frame_bytes(ShownAs kind, const jobs::ShownMesh& mesh) {
  const std::uint32_t head[] = {0x57525546,
                                static_cast<std::uint32_t>(kind),
                                static_cast<std::uint32_t>(mesh.positions.size() / 3),
                                static_cast<std::uint32_t>(mesh.faces.size() / 3),
                                static_cast<std::uint32_t>(mesh.edges.size()),
                                static_cast<std::uint32_t>(mesh.pinned.size())};
  std::string bytes(reinterpret_cast<const char*>(head), sizeof head);
  add_list(bytes, mesh.positions);
  add_list(bytes, mesh.undrawn);
  add_list(bytes, mesh.faces);
  add_list(bytes, mesh.edges);
  add_list(bytes, mesh.pinned);
  return bytes;
}

std::string moving_bytes(double time, const std::vector<float>& positions, ShownAs kind) {
  const std::uint32_t head[] = {0x57525546, static_cast<std::uint32_t>(kind),
                                static_cast<std::uint32_t>(positions.size() / 3),
                                static_cast<std::uint32_t>(std::lround(1000 * time))};
  std::string bytes(reinterpret_cast<const char*>(head), sizeof head);
  add_list(bytes, positions);
  return bytes;
}

std::string colour_bytes(const std::vector<std::uint8_t>& colours) {
  const std::uint32_t head[] = {0x57525546, static_cast<std::uint32_t>(ShownAs::colours),
                                static_cast<std::uint32_t>(colours.size() / 3), 0};
  std::string bytes(reinterpret_cast<const char*>(head), sizeof head);
  add_list(bytes, colours);
  return bytes;
}

std::string as_kind(std::string bytes, ShownAs kind) {
  const auto word = static_cast<std::uint32_t>(kind);
  if (bytes.size() >= 8) std::memcpy(bytes.data() + 4, &word, 4);
  return bytes;
}

}  // namespace furrow::studio
