// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/frame_bytes.h"

#include <algorithm>
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

bool is_frame(const std::string& bytes) {
  constexpr std::size_t words_of_head = 6;
  std::vector<std::uint32_t> words(bytes.size() / 4);
  if (bytes.size() % 4 != 0 || words.size() < words_of_head) return false;
  std::memcpy(words.data(), bytes.data(), bytes.size());
  const std::uint64_t vertices = words[2], faces = words[3], edges = words[4], pins = words[5];
  if (words[0] != 0x57525546 || words[1] != static_cast<std::uint32_t>(ShownAs::cloth) ||
      words.size() != words_of_head + 6 * vertices + 3 * faces + 3 * edges + pins)
    return false;
  const auto first = words.begin() + std::ptrdiff_t(words_of_head + 6 * vertices);
  const auto is_vertex = [&](std::uint32_t v) { return v < vertices; };
  const auto first_edge = first + std::ptrdiff_t(3 * faces),
             first_pin = first_edge + std::ptrdiff_t(3 * edges);
  bool sound = std::all_of(first, first_edge, is_vertex) && std::all_of(first_pin, words.end(), is_vertex);
  for (auto edge = first_edge; edge != first_pin; edge += 3)
    sound = sound && is_vertex(edge[0]) && is_vertex(edge[1]);
  return sound;
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
