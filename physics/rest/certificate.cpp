// SPDX-License-Identifier: MIT
#include "physics/rest/certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "physics/base/cancel_scope.h"
#include "physics/base/require.h"
#include "physics/cloth/check_cloth.h"
#include "physics/cloth/elements.h"
#include "physics/contact/residual_force.h"
#include "physics/linear/free_stiffness.h"
#include "physics/linear/lanczos.h"
#include "physics/rest/stiffness_work.h"

namespace furrow::physics {
namespace {

constexpr double least_push = 1e-6;  // of the weight
constexpr double hold = 1e6;         // over the mean diagonal
constexpr double neutral = 1e-6;     // 1/s^2
constexpr double shift_factor = 4;   // the nearer to the eigenvalue, the fewer steps find it
constexpr double enough = 1e-11;     // relative error of (lambda + shift)^-1

using Vectors = std::vector<Vec3>;

void check(const Cloth& cloth, const CertificateOptions& o, std::span<const Vec3> loads) {
  constexpr const char* me = "certify";
  if (!o.gravity.allFinite()) refuse(me, "gravity is not finite");
  require(me, "friction", o.friction, o.friction >= 0, ">= 0");
  require(me, "gap", o.gap, o.gap > 0, "> 0");
  if (o.max_steps < 2) refuse(me, "max_steps = ", o.max_steps, " is not >= 2");
  check_cloth(cloth, me);
  check_loads(cloth, loads, me);
  if (!has_all_stiffness(cloth))
    refuse(me, "an energy of the cloth has no stiffness: whether the state is stable is not known");
}

/// Second derivative of the field in the tangent plane of n [1/m], by central differences.
Mat3 curvature(const Collider& body, const Vec3& x, const Vec3& n, double step) {
  Mat3 second;
  for (int i = 0; i < 3; ++i) {
    const Vec3 e = step * Vec3::Unit(i);
    second.col(i) = (body.smooth_at(x + e).gradient - body.smooth_at(x - e).gradient) / (2 * step);
  }
  const Mat3 tangent = Mat3::Identity() - n * n.transpose();
  return tangent * (0.5 * (second + second.transpose())) * tangent;
}

/// What a particle's contact adds to K, and its kind.
struct Support {
  int particle;
  Mat3 stiffness;
};

class Certifier {
 public:
  Certifier(const Cloth& cloth, const CertificateOptions& o, const Collider* body,
            std::span<const Vec3> loads)
      : cloth_(cloth), options_(o), stiffness_(stiffness_for(cloth, false, o.work)) {
    stiffness_->assemble(cloth, cloth.particles.x, Stiffness::exact);
    if (body) find_supports(*body, loads);
  }

  Certificate run() {
    result_.smallest_eigenvalue = std::numeric_limits<double>::infinity();
    if (stiffness_->free_particles() == 0) return result_;
    for (const Support& s : supports_) stiffness_->add(s.particle, s.stiffness);
    double shift = 0;
    const auto is_definite_with = [&](double wanted) {
      add_masses(wanted - std::exchange(shift, wanted));
      return stiffness_->factorise_definite();
    };
    if (!is_definite_with(neutral)) {
      result_.negative_eigenvalues = options_.count ? stiffness_->negative_eigenvalues() : -1;
      for (double wanted = 1; !is_definite_with(wanted); wanted *= shift_factor)
        if (!(wanted < 1e20)) refuse("certify", "a stiffness is not finite");
    }
    find_smallest(shift);
    return result_;
  }

 private:
  void find_supports(const Collider& body, std::span<const Vec3> loads) {
    const Particles& p = cloth_.particles;
    Vectors force(p.size(), Vec3::Zero());
    if (!loads.empty()) force.assign(loads.begin(), loads.end());
    add_forces(cloth_, p.x, force);
    const double g = options_.gravity.norm() > 0 ? options_.gravity.norm() : standard_gravity;
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (!(p.inv_mass[i] > 0)) continue;
      const SignedDistance field = body.smooth_at(p.x[i]);
      const double slope = field.gradient.norm(), weight = g / p.inv_mass[i];
      if (!(field.value <= options_.gap + contact_tolerance) || !(slope > 0)) continue;
      const Vec3 n = field.gradient / slope, push = -(force[i] + options_.gravity / p.inv_mass[i]);
      const double normal = push.dot(n);
      if (!(normal > least_push * weight)) continue;
      const double most = hold * std::max(stiffness_->mean_diagonal(), weight / options_.gap);
      if ((push - normal * n).norm() < options_.friction * normal) {
        ++result_.sticking;
        supports_.push_back({int(i), most * Mat3::Identity()});
        continue;
      }
      ++result_.sliding;
      supports_.push_back(
          {int(i), most * n * n.transpose() - normal / slope * curvature(body, p.x[i], n, options_.gap)});
    }
  }

  /// K becomes K + shift M.
  void add_masses(double shift) {
    const auto& inverse = cloth_.particles.inv_mass;
    for (std::size_t i = 0; i < inverse.size(); ++i) {
      if (inverse[i] > 0) stiffness_->add(int(i), shift / inverse[i] * Mat3::Identity());
    }
  }

  /// M^1/2 of the free particles, 0 of the held ones [kg^1/2].
  std::vector<double> roots_of_masses() const {
    std::vector<double> root;
    for (const double w : cloth_.particles.inv_mass) root.push_back(w > 0 ? 1 / std::sqrt(w) : 0);
    return root;
  }

  /// The same numbers in every run, in all directions.
  static Eigen::VectorXd start(std::span<const double> root) {
    Eigen::VectorXd v(Eigen::Index(3 * root.size()));
    std::uint64_t state = 1;
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      v[i] = root[std::size_t(i / 3)] * (double(state >> 11) * 0x1p-53 + 0.1);
    }
    return v;
  }

  /// The largest eigenvalue of M^1/2 (K + shift M)^-1 M^1/2 is 1 / (lambda + shift); its vector is M^1/2 v.
  void find_smallest(double shift) {
    const std::vector<double> root = roots_of_masses();
    Vectors u(root.size());
    const auto scaled = [&](const Eigen::VectorXd& q, std::size_t i) {
      return Vec3(root[i] * q.segment<3>(Eigen::Index(3 * i)));
    };
    const LinearOperator inverse = [&](const Eigen::VectorXd& q, Eigen::VectorXd& product) {
      throw_if_cancelled("certify");
      for (std::size_t i = 0; i < u.size(); ++i) u[i] = scaled(q, i);
      stiffness_->solve(u);
      for (std::size_t i = 0; i < u.size(); ++i) product.segment<3>(Eigen::Index(3 * i)) = root[i] * u[i];
    };
    const int most = std::min(options_.max_steps, 3 * stiffness_->free_particles());
    const LanczosResult found =
        largest_eigenvalue(inverse, start(root), {.tolerance = enough, .most_steps = most});
    result_.smallest_eigenvalue = 1 / found.value - shift;
    if (result_.smallest_eigenvalue > 0)
      result_.frequency = std::sqrt(result_.smallest_eigenvalue) / (2 * std::numbers::pi);
    keep_mode(found.vector());
  }

  void keep_mode(const Eigen::VectorXd& vector) {
    Vectors& mode = result_.mode;
    const std::vector<double>& inverse = cloth_.particles.inv_mass;
    double longest = 0;
    for (std::size_t i = 0; i < inverse.size(); ++i) {
      mode.push_back(inverse[i] > 0 ? Vec3(std::sqrt(inverse[i]) * vector.segment<3>(Eigen::Index(3 * i)))
                                    : Vec3::Zero());
      longest = std::max(longest, mode.back().norm());
    }
    for (Vec3& v : mode) v /= longest;
  }

  const Cloth& cloth_;
  const CertificateOptions& options_;
  const std::shared_ptr<FreeStiffness> stiffness_;
  std::vector<Support> supports_;
  Certificate result_;
};

}  // namespace

Certificate certify(const Cloth& cloth, const CertificateOptions& o, const Collider* collider,
                    std::span<const Vec3> loads) {
  check(cloth, o, loads);
  Certificate result = Certifier(cloth, o, collider, loads).run();
  result.residual = residual_force(cloth, o.gravity, collider, o.friction, o.gap, loads);
  return result;
}

}  // namespace furrow::physics
