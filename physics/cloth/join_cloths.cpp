// SPDX-License-Identifier: MIT
#include "physics/cloth/join_cloths.h"

#include <array>

#include "physics/base/require.h"
#include "physics/cloth/patch_membrane.h"

namespace furrow::physics {
namespace {

/// An energy of one cloth among the particles of all.
class ShiftedEnergy : public Energy {
 public:
  ShiftedEnergy(std::shared_ptr<const Energy> own, std::size_t first, std::size_t count)
      : own_(std::move(own)), first_(first), count_(count) {}
  double energy(std::span<const Vec3> x) const override { return own_->energy(x.subspan(first_, count_)); }
  void add_forces(std::span<const Vec3> x, std::span<Vec3> force) const override {
    own_->add_forces(x.subspan(first_, count_), force.subspan(first_, count_));
  }
  double add_energy_and_forces(std::span<const Vec3> x, std::span<Vec3> force) const override {
    return own_->add_energy_and_forces(x.subspan(first_, count_), force.subspan(first_, count_));
  }
  bool add_stiffness(std::span<const Vec3> x, Stiffness stiffness, const BlockSink& sink) const override {
    const int first = int(first_);
    return own_->add_stiffness(
        x.subspan(first_, count_), stiffness,
        [&sink, first](int i, int j, const Mat3& block) { sink(i + first, j + first, block); });
  }

 private:
  std::shared_ptr<const Energy> own_;
  std::size_t first_, count_;
};

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

template <std::size_t N>
void shift(std::array<int, N>& vertices, int by) {
  for (int& v : vertices) v += by;
}
template <class Element>
void shift(Element& e, int by) {
  if constexpr (requires { e.a; }) {
    e.a += by;
    e.b += by;
  } else {
    shift(e.vertices, by);
  }
}

template <class Element>
void append_shifted(std::vector<Element>& all, std::vector<Element> more, int by) {
  for (Element& e : more) shift(e, by);
  append(all, more);
}

std::shared_ptr<const Energy> shifted(const std::shared_ptr<const Energy>& own, std::size_t first,
                                      std::size_t count) {
  const auto* membrane = dynamic_cast<const PatchMembrane*>(own.get());
  if (!membrane) return std::make_shared<ShiftedEnergy>(own, first, count);
  Patches patches = membrane->patches();
  for (Patches::Edge& e : patches.edges) shift(e, int(first));
  return std::make_shared<PatchMembrane>(std::move(patches), first + count);
}

}  // namespace

Cloth join_cloths(std::span<const Cloth> cloths) {
  Cloth all;
  for (const Cloth& c : cloths) {
    if (!c.hinges.empty() && !all.hinges.empty() && c.hinge_law != all.hinge_law)
      refuse("join_cloths", "hinges of several laws");
    const std::size_t first = all.particles.size();
    const int by = int(first);
    append(all.particles.x, c.particles.x);
    append(all.particles.v, c.particles.v);
    append(all.particles.mass, c.particles.mass);
    append(all.particles.inv_mass, c.particles.inv_mass);
    append_shifted(all.structural, c.structural, by);
    append_shifted(all.bending, c.bending, by);
    append_shifted(all.membrane, c.membrane, by);
    append_shifted(all.tension, c.tension, by);
    if (!c.hinges.empty()) all.hinge_law = c.hinge_law;
    append_shifted(all.hinges, c.hinges, by);
    append_shifted(all.triangles, c.triangles, by);
    for (Rider r : c.riders) {
      r.particle += by;
      shift(r.triangle, by);
      all.riders.push_back(r);
    }
    for (const auto& e : c.energies) all.energies.push_back(shifted(e, first, c.particles.size()));
  }
  return all;
}

}  // namespace furrow::physics
