// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/fall_watch.h"

#include <algorithm>

#include "bridge/arrays/convert.h"
#include "geometry/mesh/struts.h"
#include "jobs/base/part_names.h"

namespace furrow::jobs {
namespace {

constexpr double far = 0.25;      // [m] a part that came so far, and lies on nothing, falls
constexpr double lost_way = 0.1;  // [m] down: a part is not where it was worn; settling takes below 2 cm

/// That nine tenths of some ways down have at least [m].
double fallen(std::vector<double> down) {
  if (down.empty()) return 0;
  const auto tenth = down.begin() + std::ptrdiff_t(down.size() / 10);
  std::nth_element(down.begin(), tenth, down.end());
  return *tenth;
}

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

std::vector<int> FallWatch::find(std::span<const physics::Vec3> x, const std::vector<char>& held) const {
  if (count() < 2) return {};
  std::vector<char> carried(count(), 0);
  std::vector<int> seeds(count(), -1);
  for (std::size_t i = 0; i < start_.size(); ++i) {
    const int part = parts_.of_vertex[i];
    if (part < 0) continue;
    if (seeds[std::size_t(part)] < 0) seeds[std::size_t(part)] = int(i);
    char& here = carried[std::size_t(part)];
    here = here || held[i] || (x[i] - start_[i]).norm() < far ||
           (body_ && body_->field.at(x[i]).value < 2 * gap_);
  }
  carry_tied(tied_, carried);
  std::vector<int> falling;
  for (std::size_t p = 0; p < count(); ++p)
    if (!carried[p] && seeds[p] >= 0) falling.push_back(seeds[p]);
  if (falling.size() == count()) falling.clear();
  return falling;
}

/// By part, whether one of its vertices, or of those of a part tied to it, is held.
std::vector<char> FallWatch::pinned(const std::vector<char>& held) const {
  std::vector<char> result(count(), 0);
  for (std::size_t i = 0; i < start_.size(); ++i)
    if (parts_.of_vertex[i] >= 0 && held[i]) result[std::size_t(parts_.of_vertex[i])] = 1;
  carry_tied(tied_, result);
  return result;
}

std::vector<PartEnd> FallWatch::ends(const io::MeshFile& file, std::span<const physics::Vec3> x,
                                     const std::vector<char>& held, std::span<const int> aside,
                                     const physics::Vec3& gravity) const {
  std::vector<PartEnd> result(count());
  std::vector<std::vector<double>> down(count());
  const physics::Vec3 way = gravity.isZero() ? gravity : physics::Vec3(gravity.normalized());
  for (std::size_t i = 0; i < start_.size(); ++i)
    if (const int part = parts_.of_vertex[i]; part >= 0)
      down[std::size_t(part)].push_back((x[i] - start_[i]).dot(way));
  const std::vector<char> carried = pinned(held);
  for (const int seed : aside) result[std::size_t(parts_.of_vertex[std::size_t(seed)])].held = true;
  for (std::size_t p = 0; p < count(); ++p) {
    result[p].name = name_of_part(file, parts_, int(p));
    if (result[p].held) continue;
    result[p].fallen = fallen(std::move(down[p]));
    result[p].lost = !carried[p] && !(result[p].fallen <= lost_way);
  }
  return result;
}

}  // namespace furrow::jobs
