// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/fabrics.h"

#include <algorithm>
#include <stdexcept>

#include "physics/cloth/tension_forces.h"

namespace furrow::io {
namespace {

// Density, stretch, shear and rigidity: Wang, O'Brien, Ramamoorthi, "Data-driven elastic models for cloth",
// ACM Trans. Graph. 30(4), 2011, as published with ARCSim (files materials/*.json). Stretch: mean of c11 and
// c22 of the first sample, doubled as ARCSim does on loading; shear: c33 doubled; rigidity: mean of the three
// directions' first entries.
constexpr const char* wang = "Wang, O'Brien, Ramamoorthi 2011 (ARCSim materials)";
constexpr const char* interlock =
    "no single jersey was measured there: the numbers of interlock, a double jersey (Wang et al. 2011)";
constexpr const char* ours = "thickness, damping, friction";
// B of three weaves: Matsudaira et al., J. Textile Eng. 61(6), 2015, 69.
constexpr const char* matsudaira = "rigidity: Matsudaira et al. 2015";
constexpr const char* most_ours = "all but the rigidity";

constexpr Fabric all_fabrics[] = {
    {"cotton", 0.12, 1000, 60, 1.157e-5, 0.0003, 0.02, 0.4, matsudaira, most_ours},
    {"wool", 0.18, 600, 60, 6.57e-6, 0.0005, 0.02, 0.4, matsudaira, most_ours},
    {"silk", 0.08, 1000, 40, 1.863e-6, 0.0002, 0.02, 0.25,
     "rigidity: polyester faille of Matsudaira et al. 2015", most_ours},
    {"denim", 0.324, 1219.2, 106.8, 7.82e-5, 0.0007, 0.02, 0.4, wang, ours},
    {"interlock", 0.187, 51.07, 73.7, 2.07e-5, 0.0007, 0.02, 0.4, wang, ours},
    {"jersey", 0.187, 51.07, 73.7, 2.07e-5, 0.0007, 0.02, 0.4, interlock, ours},
    {"rib-knit", 0.276, 108.0, 166.4, 3.62e-5, 0.001, 0.02, 0.4, wang, ours},
    {"jet-set", 0.113, 214.5, 28.6, 1.89e-5, 0.0003, 0.02, 0.3, wang, ours},
    {"dots", 0.128, 4029.6, 38.4, 4.12e-5, 0.0003, 0.02, 0.3, wang, ours},
    {"target", 0.220, 4051.5, 209.5, 1.196e-4, 0.0005, 0.02, 0.4, wang, ours},
};

}  // namespace

std::span<const Fabric> fabrics() { return all_fabrics; }

const Fabric& fabric_named(const std::string& name) {
  for (const Fabric& fabric : all_fabrics)
    if (name == fabric.name) return fabric;
  throw std::invalid_argument("there is no fabric '" + name + "'");
}

double tension_constant(double stretch) { return stretch / physics::working_strain; }

double shear_ratio(const Fabric& fabric) { return std::min(1.0, 4 * fabric.shear / fabric.stretch); }

}  // namespace furrow::io
