// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "physics/base/arrays.h"
#include "physics/body/collider.h"
#include "physics/body/moving_body.h"

namespace furrow::tests {

using physics::Vec3;

/// The half-space y < 0.
struct Floor : physics::Collider {
  physics::SignedDistance at(const Vec3& x) const override { return {x.y(), Vec3::UnitY()}; }
};

struct Sphere : physics::Collider {
  Vec3 centre;
  double radius;
  Sphere(const Vec3& c, double r) : centre(c), radius(r) {}
  physics::SignedDistance at(const Vec3& x) const override {
    return {(x - centre).norm() - radius, (x - centre).normalized()};
  }
};

/// |y| < half, endless.
struct Slab : physics::Collider {
  double half;
  explicit Slab(double h) : half(h) {}
  physics::SignedDistance at(const Vec3& x) const override {
    return {std::abs(x.y()) - half, Vec3(0, x.y() < 0 ? -1 : 1, 0)};
  }
};

/// A sphere of 2 * columns * (rows - 1) triangles; its poles lie on y.
inline physics::TriangleMesh sphere_mesh(double radius, int columns = 32, int rows = 16) {
  constexpr double pi = 3.14159265358979323846;
  physics::TriangleMesh mesh;
  mesh.vertices.push_back({0, radius, 0});
  for (int r = 1; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double a = pi * r / rows, b = 2 * pi * c / columns;
      mesh.vertices.push_back(radius *
                              Vec3(std::sin(a) * std::sin(b), std::cos(a), std::sin(a) * std::cos(b)));
    }
  }
  mesh.vertices.push_back({0, -radius, 0});
  const auto at = [&](int r, int c) { return 1 + (r - 1) * columns + c % columns; };
  const int last = int(mesh.vertices.size()) - 1;
  for (int c = 0; c < columns; ++c) {
    mesh.triangles.push_back({0, at(1, c), at(1, c + 1)});
    for (int r = 1; r + 1 < rows; ++r) {
      mesh.triangles.push_back({at(r, c), at(r + 1, c), at(r + 1, c + 1)});
      mesh.triangles.push_back({at(r, c), at(r + 1, c + 1), at(r, c + 1)});
    }
    mesh.triangles.push_back({at(rows - 1, c), last, at(rows - 1, c + 1)});
  }
  return mesh;
}

/// Keyframes once a second from -2 s on, between which the translation is v t from -1 s to `until`.
inline physics::RigidMotion uniform_motion(const Vec3& v, int until, const Vec3& rotation = Vec3::Zero()) {
  physics::RigidMotion motion;
  for (int i = -2; i <= until + 1; ++i) motion.keyframes.push_back({double(i), i * v, rotation});
  return motion;
}

}  // namespace furrow::tests
