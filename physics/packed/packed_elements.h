// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <vector>

#include "physics/base/thread_pool.h"
#include "physics/base/vec4.h"
#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// Membrane triangles, tension and hinges laid out for speed: four at a time, by places instead of particles,
/// sorted by their least place; the last four are filled up with copies that nobody reads. Each element
/// writes the forces on its corners into slots of its own, then each particle gathers its slots in their
/// order, so that any number of threads gives the same bits.
struct PackedElements {
  struct alignas(32) FourTriangles {
    double length2[3][4];    ///< L^2 [m^2]
    double quadratic[6][4];  ///< H00, H11, H22, H12, H20, H01 of MembraneConstants [N/m^3]
    int corner[3][4];
  };
  struct alignas(32) FourTensions {
    double rest_length[4], stretch[4], compress[4];
    int end[2][4];
  };
  struct alignas(32) FourHinges {
    double rest_angle[4], stiffness[4];
    int vertex[4][4];
  };
  int triangle_count = 0, tension_count = 0, hinge_count = 0;  ///< without the copies
  std::vector<FourTriangles> triangles;
  std::vector<FourTensions> tensions;
  std::vector<FourHinges> hinges;
  HingeLaw law = HingeLaw::linear;
  std::vector<Vec4> slot;         ///< forces [N]: three a triangle, two a tension, four a hinge
  std::vector<int> gather_begin;  ///< of each place its first entry in `gather`, and the end
  std::vector<int> gather;        ///< slots
  std::vector<double> energy;     ///< of each element and the copies, where it is asked for [J]
};

/// Whether a kind is laid out for speed; what is not goes through add_other_forces() (packed_cloth.h).
template <class Element>
inline constexpr bool is_laid_out =
    std::same_as<Element, Spring> || std::same_as<Element, MembraneTriangle> ||
    std::same_as<Element, Tension> || std::same_as<Element, Hinge>;

/// place: of each particle. The elements must have passed check_elements().
PackedElements pack_elements(const Cloth& cloth, const std::vector<int>& place);

/// Adds the elements' forces at x to force, as the functions of elements.h but for rounding. A
/// hinge whose edge or flap has collapsed (see dihedral.h) exerts none. Cost: no division a triangle, two
/// and a square root a tension, five and a square root a hinge (and a sine by the cosine law); no allocation;
/// nothing without elements.
void add_element_forces(PackedElements& elements, const std::vector<Vec4>& x, std::vector<Vec4>& force,
                        ThreadPool& pool);
/// The same, and returns their energy [J].
double add_element_forces_and_energy(PackedElements& elements, const std::vector<Vec4>& x,
                                     std::vector<Vec4>& force, ThreadPool& pool);

}  // namespace furrow::physics
