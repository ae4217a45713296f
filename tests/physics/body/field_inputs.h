// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "physics/base/arrays.h"

namespace furrow::tests {

/// Vertices and faces of an OBJ file; polygons are cut from their first corner.
inline physics::TriangleMesh read_obj(const std::filesystem::path& path) {
  physics::TriangleMesh mesh;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      double x, y, z;
      words >> x >> y >> z;
      mesh.vertices.emplace_back(x, y, z);
    } else if (word == "f") {
      std::vector<int> corners;
      while (words >> word) corners.push_back(std::stoi(word) - 1);
      for (std::size_t i = 2; i < corners.size(); ++i)
        mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }
  return mesh;
}

struct Measured {
  physics::Vec3 x;
  double distance;
};

/// Rows x,y,z,signed_distance after one heading line.
inline std::vector<Measured> read_distances(const std::filesystem::path& path) {
  std::vector<Measured> rows;
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    for (char& c : line)
      if (c == ',') c = ' ';
    std::istringstream numbers(line);
    Measured row;
    numbers >> row.x[0] >> row.x[1] >> row.x[2] >> row.distance;
    rows.push_back(row);
  }
  return rows;
}

/// A sphere of latitude and longitude lines; closed, faces outwards.
inline physics::TriangleMesh sphere(int rings, double radius, const physics::Vec3& centre = {0, 0, 0}) {
  physics::TriangleMesh m;
  const int around = 2 * rings;
  const double pi = 3.14159265358979323846;
  m.vertices.push_back(centre + physics::Vec3(0, 0, radius));
  for (int r = 1; r < rings; ++r)
    for (int k = 0; k < around; ++k) {
      const double polar = pi * r / rings, turn = 2 * pi * k / around;
      m.vertices.push_back(centre + radius * physics::Vec3(std::sin(polar) * std::cos(turn),
                                                           std::sin(polar) * std::sin(turn),
                                                           std::cos(polar)));
    }
  const int last = static_cast<int>(m.vertices.size());
  m.vertices.push_back(centre - physics::Vec3(0, 0, radius));
  const auto at = [&](int r, int k) {
    return r == 0 ? 0 : r == rings ? last : 1 + (r - 1) * around + k % around;
  };
  for (int r = 0; r < rings; ++r)
    for (int k = 0; k < around; ++k) {
      if (r + 1 < rings) m.triangles.push_back({at(r, k), at(r + 1, k), at(r + 1, k + 1)});
      if (r > 0) m.triangles.push_back({at(r, k), at(r + 1, k + 1), at(r, k + 1)});
    }
  return m;
}

/// A box of 12 triangles, faces outwards.
inline physics::TriangleMesh box(const physics::Vec3& low, const physics::Vec3& high) {
  physics::TriangleMesh m;
  for (int i = 0; i < 8; ++i)
    m.vertices.emplace_back(i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]);
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return m;
}

inline void append(physics::TriangleMesh& to, const physics::TriangleMesh& from) {
  const int shift = static_cast<int>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), from.vertices.begin(), from.vertices.end());
  for (const auto& t : from.triangles) to.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
}

inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// A point of a random triangle.
inline physics::Vec3 on_surface(const physics::TriangleMesh& m, std::mt19937_64& random) {
  const auto& t = m.triangles[random() % m.triangles.size()];
  double u = uniform(random, 0, 1), v = uniform(random, 0, 1);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  const physics::Vec3 &a = m.vertices[t[0]], &b = m.vertices[t[1]], &c = m.vertices[t[2]];
  return a + u * (b - a) + v * (c - a);
}

}  // namespace furrow::tests
