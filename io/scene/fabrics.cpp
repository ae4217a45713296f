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
#define ARCSIM(file) "Wang, O'Brien, Ramamoorthi 2011 (ARCSim materials/" file ".json)"
constexpr const char* interlock =
    "no single jersey was measured there: the numbers of interlock, a double jersey (Wang et al. 2011)";
constexpr const char* ours = "thickness, damping, friction";
// B and 2HB of three weaves: Matsudaira et al., J. Textile Eng. 61(6), 2015, 69.
constexpr const char* matsudaira = "rigidity, bending friction: Matsudaira et al. 2015";
constexpr const char* faille = "rigidity, bending friction: polyester faille of Matsudaira et al. 2015";
constexpr const char* most_ours = "all but the rigidity and the bending friction";

// KES-FB, converted to N/m and N m by g/s^2 = 1e-3 N/m and g mm^2/s^2 = 1e-9 N m; drape coefficients
// measured. Bias: B_t = sqrt(B1 B2) / 2, as of a sheet without threads, for all of them.
constexpr const char* petrak =
    "KES-FB and drape coefficient: Petrak et al., Sustainability 2025, 17, 1388 (CC BY 4.0)";
constexpr const char* bias_ours = "rigidity at 45 degrees, Poisson's ratio, damping, friction";

// Of Wang et al.: C of the first sample, doubled, entries below 0 as 0, inverted for strips; bending rows as
// warp, bias, weft. ARCSim reads them by the direction of the crease, a quarter turn away.
// Stretch along warp and weft, shear; Poisson's ratio; rigidity along warp, bias, weft; drape coefficient.
constexpr FabricThreads black_denim{410.5, 2027, 106.8, 0.01009, 6.42e-05, 7.338e-05, 9.695e-05, 0};
constexpr FabricThreads ivory_rib{85.74, 130.3, 166.4, 0, 4.624e-05, 3.002e-05, 3.224e-05, 0};
constexpr FabricThreads brown_ribbon{211.2, 341.3, 60.5, 0.4331, 0.0001171, 8.751e-05, 5.977e-05, 0};
constexpr FabricThreads white_dots{4004, 4055, 38.38, 0.0001705, 5.171e-05, 4.066e-05, 3.128e-05, 0};
constexpr FabricThreads camel_ponte{62.29, 88.06, 63.79, 0, 3.635e-05, 3.301e-05, 3.716e-05, 0};
constexpr FabricThreads gray_interlock{33.19, 68.95, 73.72, 0, 2.319e-05, 2.475e-05, 1.427e-05, 0};
constexpr FabricThreads red_jet_set{51.64, 205.6, 28.63, 0.3172, 1.429e-05, 2.195e-05, 2.035e-05, 0};
constexpr FabricThreads polyester_twill{477.2, 458.6, 41, 0, 1.95e-06, 1.004e-06, 6.1e-07, 0.223};
constexpr FabricThreads polyester_plain{471.9, 373.5, 46, 0, 8.5e-07, 5.011e-07, 3.3e-07, 0.228};
constexpr FabricThreads wool_twill{449.7, 439.8, 50, 0, 2.14e-06, 2.068e-06, 2e-06, 0.349};
constexpr FabricThreads viscose_twill{403.4, 401.8, 61, 0, 2.97e-06, 2.662e-06, 2.4e-06, 0.286};
constexpr FabricThreads elastane_plain{407.2, 415, 57, 0, 3.22e-06, 3.527e-06, 3.88e-06, 0.443};
constexpr FabricThreads cotton_twill{473.9, 404.7, 126, 0, 7.43e-06, 5.087e-06, 3.7e-06, 0.549};

// Density, stretch, shear, rigidity, thickness, friction; source, what is ours; threads, bending friction.
constexpr Fabric all_fabrics[] = {
    {"cotton", 0.12, 1000, 60, 1.157e-5, 0.0003, 0.4, matsudaira, most_ours, {}, 6.08e-4},
    {"wool", 0.18, 600, 60, 6.57e-6, 0.0005, 0.4, matsudaira, most_ours, {}, 1.62e-4},
    {"silk", 0.08, 1000, 40, 1.863e-6, 0.0002, 0.25, faille, most_ours, {}, 3.45e-5},
    {"denim", 0.324, 1219.2, 106.8, 7.82e-5, 0.0007, 0.4, wang, ours},
    {"interlock", 0.187, 51.07, 73.7, 2.07e-5, 0.0007, 0.4, wang, ours},
    {"jersey", 0.187, 51.07, 73.7, 2.07e-5, 0.0007, 0.4, interlock, ours},
    {"rib-knit", 0.276, 108.0, 166.4, 3.62e-5, 0.001, 0.4, wang, ours},
    {"jet-set", 0.113, 214.5, 28.6, 1.89e-5, 0.0003, 0.3, wang, ours},
    {"dots", 0.128, 4029.6, 38.4, 4.12e-5, 0.0003, 0.3, wang, ours},
    {"target", 0.220, 4051.5, 209.5, 1.196e-4, 0.0005, 0.4, wang, ours},
    // With threads.
    {"black-denim", 0.324, 1219, 106.8, 7.818e-05, 0.0007, 0.4, ARCSIM("11oz-black-denim"), ours,
     black_denim},
    {"ivory-rib", 0.276, 108, 166.4, 3.617e-05, 0.001, 0.4, ARCSIM("ivory-rib-knit"), ours, ivory_rib},
    {"brown-ribbon", 0.228, 276.2, 60.5, 8.812e-05, 0.0007, 0.4, ARCSIM("pink-ribbon-brown"), ours,
     brown_ribbon},
    {"white-dots", 0.128, 4030, 38.38, 4.122e-05, 0.0003, 0.3, ARCSIM("white-dots-on-blk"), ours, white_dots},
    {"camel-ponte", 0.284, 75.17, 63.79, 3.551e-05, 0.001, 0.4, ARCSIM("camel-ponte-roma"), ours,
     camel_ponte},
    {"gray-interlock", 0.187, 51.07, 73.72, 2.074e-05, 0.0007, 0.4, ARCSIM("gray-interlock"), ours,
     gray_interlock},
    {"red-jet-set", 0.113, 128.6, 28.63, 1.886e-05, 0.0003, 0.3, ARCSIM("tango-red-jet-set"), ours,
     red_jet_set},
    {"polyester-twill", 0.1352, 467.9, 41, 1.188e-06, 0.00031, 0.4, petrak, bias_ours, polyester_twill},
    {"polyester-plain", 0.08366, 422.7, 46, 5.604e-07, 0.00025, 0.4, petrak, bias_ours, polyester_plain},
    {"wool-twill", 0.1787, 444.7, 50, 2.069e-06, 0.0004, 0.4, petrak, bias_ours, wool_twill},
    {"viscose-twill", 0.2861, 402.6, 61, 2.677e-06, 0.00061, 0.4, petrak, bias_ours, viscose_twill},
    {"elastane-plain", 0.242, 411.1, 57, 3.542e-06, 0.00056, 0.4, petrak, bias_ours, elastane_plain},
    {"cotton-twill", 0.2534, 439.3, 126, 5.406e-06, 0.00062, 0.4, petrak, bias_ours, cotton_twill},
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
