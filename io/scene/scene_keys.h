// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace furrow::io {

/// The tables of a scene that a key belongs to as one would write them, "[simulation]"; empty for a key that
/// none has. For messages: what is read, scene_file.cpp says.
inline std::string tables_of_key(std::string_view key) {
  using namespace std::string_view_literals;
  constexpr std::array scene_tables = {
      std::pair{"[garment]"sv, " mesh subdivide rest "sv},
      std::pair{"[[lines]]"sv,
                " strokes time height fade without rule rest region max_distance iterations "
                "lambda mu weights keep_lines keep_border "sv},
      std::pair{"[body]"sv, " mesh field frames fps tolerance gradient collider motion "sv},
      std::pair{"[material]"sv,
                " preset density stiffness bending membrane bending_law stretch poisson rigidity tension "
                "compression shear mass_rule damping drag friction gap "sv},
      std::pair{"[[pins]]"sv, " box loop group vertices motion "sv},
      std::pair{"[forces]"sv, " gravity wind gusts swirl "sv},
      std::pair{"[simulation]"sv, " seconds stop_at dt force_dt integrator sweeps newton threads "sv},
      std::pair{"[output]"sv, " mesh state inserted smoothed animation body fps "sv},
      std::pair{"motion"sv, " pivot keyframes spin "sv}};
  const std::string word = " " + std::string(key) + " ";
  std::string found;
  for (const auto& [table, keys] : scene_tables)
    if (keys.find(word) != keys.npos) found += (found.empty() ? "" : " or ") + std::string(table);
  return found;
}

}  // namespace furrow::io
