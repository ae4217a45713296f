// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/run/fall_watch.h"

#include "bridge/convert.h"
#include "geometry/mesh/struts.h"

namespace furrow::jobs {
namespace {

constexpr double far = 0.25;  // [m] a part that came so far, and lies on nothing, falls

/// What is tied to a carried part is carried.
void carry_tied(const std::vector<std::array<int, 2>>& tied, std::vector<char>& carried) {
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [p, q] : tied) {
      char& one = carried[std::size_t(p)];
      char& other = carried[std::size_t(q)];
      changed = changed || one != other;
      one = other = one | other;
    }
  }
}

}  // namespace

FallWatch::FallWatch(const geometry::Mesh& mesh, const BodyCollider* body, double gap)
    : start_(bridge::positions_of(mesh)), parts_(geometry::find_parts(mesh)), body_(body), gap_(gap) {
  for (const geometry::Strut& s : geometry::struts(mesh)) {
    const int p = parts_.of_vertex[std::size_t(s.a)], q = parts_.of_vertex[std::size_t(s.b)];
    if (p >= 0 && q >= 0 && p != q) tied_.push_back({p, q});
  }
}

std::vector<int> FallWatch::find(const physics::Cloth& cloth, const std::vector<char>& held) const {
  if (count() < 2) return {};
  std::vector<char> carried(count(), 0);
  std::vector<int> seeds(count(), -1);
  for (std::size_t i = 0; i < start_.size(); ++i) {
    const int part = parts_.of_vertex[i];
    if (part < 0) continue;
    if (seeds[std::size_t(part)] < 0) seeds[std::size_t(part)] = int(i);
    char& here = carried[std::size_t(part)];
    here = here || held[i] || (cloth.particles.x[i] - start_[i]).norm() < far ||
           (body_ && body_->field.at(cloth.particles.x[i]).value < 2 * gap_);
  }
  carry_tied(tied_, carried);
  std::vector<int> falling;
  for (std::size_t p = 0; p < count(); ++p)
    if (!carried[p] && seeds[p] >= 0) falling.push_back(seeds[p]);
  if (falling.size() == count()) falling.clear();
  return falling;
}

}  // namespace furrow::jobs
