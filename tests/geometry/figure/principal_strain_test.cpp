// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/principal_strain.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// Its rest lengths are its lengths, then it is mapped.
Mesh deformed(Mesh mesh, const Eigen::Matrix3d& map) {
  auto rest = ensure_map(mesh, attribute::rest_length);
  for (Edge e : mesh.edges()) rest[e] = spatial_length(mesh, e);
  for (Vertex v : mesh.vertices()) {
    const Eigen::Vector3d x = map * Eigen::Vector3d(mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z());
    mesh.point(v) = {x.x() + 3, x.y(), x.z() - 2};
  }
  return mesh;
}

}  // namespace

TEST_CASE(
    "principal_strain: a sheet that is stretched by 10 % one way and narrowed by 5 % the other, however it "
    "is turned") {
  Eigen::Matrix3d stretch = Eigen::Vector3d(1.10, 0.95, 1).asDiagonal();
  for (double angle : {0.0, 0.3, 1.1, 2.5}) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
    const Eigen::Matrix3d first = Eigen::AngleAxisd(2 * angle, Eigen::Vector3d::UnitZ()).matrix();
    for (const PrincipalStrain& s :
         principal_strains(deformed(jittered(6, 5, 0.2, 3), turn * stretch * first))) {
      CHECK(s.largest == Approx(0.10).epsilon(1e-9));
      CHECK(s.smallest == Approx(-0.05).epsilon(1e-9));
    }
  }
}

TEST_CASE("principal_strain: a rigid motion strains nothing, pressing from all sides is negative") {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -1, 2).normalized()).matrix();
  for (const PrincipalStrain& s : principal_strains(deformed(icosphere(2), turn))) {
    CHECK(s.largest == Approx(0).margin(1e-12));
    CHECK(s.smallest == Approx(0).margin(1e-12));
  }
  for (const PrincipalStrain& s : principal_strains(deformed(grid(3, 3), 0.8 * turn))) {
    CHECK(s.largest == Approx(-0.2));
    CHECK(s.smallest == Approx(-0.2));
  }
}

TEST_CASE(
    "principal_strain: principal strains are the singular values of the map, also of triangles that fold "
    "up") {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; ++i) {
    Eigen::Matrix3d map;
    for (int k = 0; k < 9; ++k) map(k / 3, k % 3) = normal(random);
    Mesh mesh = deformed(single_triangle(), map);
    const Eigen::Matrix<double, 3, 2> plane = map.leftCols<2>();
    const Eigen::Vector2d values = Eigen::JacobiSVD<Eigen::Matrix<double, 3, 2>>(plane).singularValues();
    const PrincipalStrain s = principal_strains(mesh)[0];
    CHECK(s.largest == Approx(values[0] - 1).margin(1e-7));
    CHECK(s.smallest == Approx(values[1] - 1).margin(1e-5));  // Heron's area near zero
  }
  Eigen::Matrix3d flat = Eigen::Vector3d(0, 2, 1).asDiagonal();  // one edge becomes a point
  const PrincipalStrain s = principal_strains(deformed(single_triangle(), flat))[0];
  CHECK(s.largest == Approx(1));
  CHECK(s.smallest == Approx(-1));
  const PrincipalStrain none = principal_strains(deformed(single_triangle(), Eigen::Matrix3d::Zero()))[0];
  CHECK(none.largest == -1);
}

TEST_CASE("principal_strain: without rest lengths there is no strain, with impossible ones it is not known") {
  Mesh mesh = grid(2, 2);
  for (const PrincipalStrain& s : principal_strains(mesh)) CHECK(s.largest == Approx(0).margin(1e-12));
  auto rest = ensure_map(mesh, attribute::rest_length);
  rest[*mesh.edges().begin()] = 100;
  int unknown = 0;
  for (const PrincipalStrain& s : principal_strains(mesh)) unknown += std::isnan(s.largest);
  CHECK(unknown >= 1);
  CHECK(unknown <= 2);
  rest[*mesh.edges().begin()] = -1;
  CHECK_THROWS_AS(principal_strains(mesh), ContentError);
}
