// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <concepts>
#include <memory>
#include <type_traits>
#include <vector>

#include "physics/base/particles.h"

namespace furrow::physics {

class Energy;

/// Energy 1/2 stiffness (l - rest_length)^2. Arrays of springs are sorted by (a, b) with a < b, so that
/// sums have one order and the same input gives the same bits.
struct Spring {
  int a, b;            ///< particle indices, a < b
  double rest_length;  ///< L [m]; > 0
  double stiffness;    ///< k [N/m]; >= 0
};

/// Quadratic, asymmetric tension (Hanami and Tokoi; method S2.2): with the strain e = (l - L) / L a pull of
/// stretch e^2 where e > 0, a push of compress e^2 where e < 0. No stiffness at rest.
struct Tension {
  int a, b;                  ///< particle indices, a < b
  double rest_length;        ///< L [m]; > 0
  double stretch, compress;  ///< force at e = 1 and e = -1 [N]; 0 <= compress <= stretch
};

/// Signed hinge between the triangles (0, 1, 2) and (1, 0, 3) of its vertices; the edge is 0-1.
struct Hinge {
  std::array<int, 4> vertices;
  double rest_angle;  ///< [rad] in [-pi, pi]; 0 = flat, > 0 = ridge
  double stiffness;   ///< [N m]
};

/// What a hinge does about its rest angle, phi = theta - rest_angle.
enum class HingeLaw {
  linear,  ///< moment stiffness * phi
  cosine   ///< moment stiffness * (1 - cos phi) against phi: none of first order about rest
};

/// Membrane of constant strain (St. Venant-Kirchhoff). It knows its rest state by lengths alone.
struct MembraneTriangle {
  std::array<int, 3> vertices;         ///< counter-clockwise from outside
  std::array<double, 3> rest_lengths;  ///< [m] of the edges opposite them; > 0 and a triangle with area
  double lambda, mu;                   ///< Lame parameters of the plane [N/m]; mu >= 0, lambda + mu >= 0
};

/// The whole state of a cloth as plain arrays.
struct Cloth {
  Particles particles;
  std::vector<Spring> structural;  ///< one for each edge
  std::vector<Spring> bending;     ///< one for each pair of vertices opposite an interior edge
  std::vector<MembraneTriangle> membrane;
  std::vector<Tension> tension;  ///< sorted by (a, b)
  std::vector<Hinge> hinges;
  HingeLaw hinge_law = HingeLaw::linear;                     ///< of all hinges
  std::vector<std::array<int, 3>> triangles;                 ///< counter-clockwise from outside
  std::vector<std::shared_ptr<const Energy>> energies = {};  ///< a caller's own (energy.h); none is null
};

/// The one list of kinds of elements: calls visit(elements, law...) for each, in the order in which all sums
/// run. law: what the elements of a kind share. A cloth that is not const hands out what may be changed.
template <class C, class Visit>
requires std::same_as<std::remove_const_t<C>, Cloth>
void for_each_kind(C& cloth, Visit&& visit) {
  visit(cloth.structural);
  visit(cloth.bending);
  visit(cloth.membrane);
  visit(cloth.tension);
  visit(cloth.hinges, cloth.hinge_law);
}

}  // namespace furrow::physics
