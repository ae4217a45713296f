// SPDX-License-Identifier: MIT
#include "physics/plate/plate.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "physics/base/cancel_scope.h"
#include "physics/base/require.h"
#include "physics/plate/plate_slopes.h"

namespace furrow::physics {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

constexpr double negligible = 1e-12;

/// N(n) of a triangle's edges, in axes whose first runs from corner 0 to corner 1.
std::array<Vector3d, 3> normal_tensors(const PlateNet::Triangle& t) {
  const FlatTriangle p = unfold(t, 2, {0, 0}, {1, 0});
  std::array<Vector3d, 3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2d d = (p[(i + 2) % 3] - p[(i + 1) % 3]).normalized();
    result[i] = {d.y() * d.y(), d.x() * d.x(), -2 * d.x() * d.y()};
  }
  return result;
}

/// D minimised over the turns at the borders `free` (no moment there): D - D N (N^T D N)^+ N^T D.
Matrix3d condensed(const Matrix3d& d, const std::vector<Vector3d>& free) {
  if (free.empty()) return d;
  if (free.size() == 3) return Matrix3d::Zero();
  Eigen::MatrixXd n(3, Eigen::Index(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) n.col(Eigen::Index(i)) = free[i];
  const Eigen::MatrixXd dn = d * n;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(n.transpose() * dn);
  Matrix3d result = d;
  for (Eigen::Index i = 0; i < modes.eigenvalues().size(); ++i) {
    const double value = modes.eigenvalues()[i];
    if (value <= negligible * modes.eigenvalues().maxCoeff()) continue;
    const Vector3d along = dn * modes.eigenvectors().col(i);
    result -= along * along.transpose() / value;
  }
  return 0.5 * (result + result.transpose());
}

/// What is added up for one triangle.
using Row = std::vector<std::pair<int, Vector3d>>;

/// psi of the triangle at one edge, as curvature.
void add(Row& row, const std::vector<HingeShare>& psi, const Vector3d& curvature) {
  for (const HingeShare& s : psi) {
    const auto known =
        std::find_if(row.begin(), row.end(), [&](const auto& e) { return e.first == s.hinge; });
    if (known != row.end())
      known->second += s.factor * curvature;
    else
      row.emplace_back(s.hinge, s.factor * curvature);
  }
}

/// theta - psi.
std::vector<HingeShare> rest_of(int hinge, std::vector<HingeShare> psi) {
  for (HingeShare& s : psi) s.factor = -s.factor;
  psi.push_back({hinge, 1});
  return psi;
}

/// The curvatures of all triangles, by hinges of the sheet.
std::vector<Row> curvatures(const PlateNet& net) {
  std::vector<Row> rows(net.triangles.size());
  const auto place = [&](const PlateNet::Side& side, const std::vector<HingeShare>& psi) {
    const std::size_t t = std::size_t(side.triangle), i = std::size_t(side.edge);
    const PlateNet::Triangle& triangle = net.triangles[t];
    if (triangle.held) return;
    add(rows[t], psi, triangle.length[i] / triangle.area * normal_tensors(triangle)[i]);
  };
  for (int h = 0; h < int(net.joints.size()); ++h) {
    const PlateNet::Joint& joint = net.joints[std::size_t(h)];
    if (h % 4096 == 0) throw_if_cancelled("plates");
    if (!joint.coupled) continue;
    const std::vector<HingeShare> left = left_share(net, h);
    place(joint.side[0], left);
    place(joint.side[1], rest_of(h, left));
  }
  return rows;
}

Matrix3d stiffness_of(const PlateNet::Triangle& t, const PlateRigidity& rigidity, double warp) {
  const std::array<Vector3d, 3> normals = normal_tensors(t);
  std::vector<Vector3d> free;
  for (std::size_t i = 0; i < 3; ++i)
    if (t.hinge[i] < 0) free.push_back(normals[i]);
  return t.area * condensed(plate_matrix(rigidity, warp), free);
}

/// Numbers the coupled hinges, in their order; -1: plain.
std::vector<int> take_hinges(const PlateSheet& sheet, const PlateNet& net, PlateParts& parts) {
  std::vector<int> number(sheet.hinges.size(), -1);
  for (std::size_t h = 0; h < number.size(); ++h) {
    if (!net.joints[h].coupled) {
      parts.plain.push_back(int(h));
      continue;
    }
    number[h] = int(parts.coupled.size());
    parts.coupled.push_back(int(h));
    parts.plate.hinges.push_back(sheet.hinges[h]);
  }
  return number;
}

}  // namespace

PlateParts make_plate(const PlateSheet& sheet, const PlateOptions& options) {
  plate_matrix(options.rigidity, 0);  // refuses what is none
  if (!options.warp.empty() && options.warp.size() != sheet.triangles.size())
    refuse("plate", sheet.triangles.size(), " triangles, but ", options.warp.size(), " directions of warp");
  const PlateNet net = plate_net(sheet);
  std::vector<Row> rows = curvatures(net);
  PlateParts parts;
  const std::vector<int> number = take_hinges(sheet, net, parts);
  Plate& plate = parts.plate;
  for (std::size_t t = 0; t < rows.size(); ++t) {
    if (t % 4096 == 0) throw_if_cancelled("plates");
    if (rows[t].empty()) continue;
    parts.slivers += net.triangles[t].sliver;
    parts.triangles.push_back(int(t));
    plate.begin.push_back(int(plate.hinge.size()));
    plate.area.push_back(net.triangles[t].area);
    plate.stiffness.push_back(
        stiffness_of(net.triangles[t], options.rigidity, options.warp.empty() ? 0 : options.warp[t]));
    std::sort(rows[t].begin(), rows[t].end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [hinge, share] : rows[t]) {
      const double press = sheet.press.empty() ? 1 : sheet.press[std::size_t(hinge)];
      plate.hinge.push_back(number[std::size_t(hinge)]);
      plate.share.push_back(press == 1 ? share : std::sqrt(press) * share);
    }
  }
  plate.begin.push_back(int(plate.hinge.size()));
  return parts;
}

}  // namespace furrow::physics
