// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <concepts>
#include <functional>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "physics/base/arrays.h"

namespace furrow::physics {

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

/// What the threads of woven cloth add to a sheet that is the same in all directions: the energy of an area
/// grows by  warp/2 (w^T E w)^2 + weft/2 (f^T E f)^2  with Green's strain E and the unit vectors w along the
/// warp and f across it. woven_sheet() of membrane.h makes both.
struct Threads {
  double angle = 0;  ///< of the warp to the edge from corner 0 to corner 1 at rest, counter-clockwise [rad]
  double warp = 0, weft = 0;  ///< [N/m]; may be < 0, as long as the whole sheet's stiffness is definite
  bool any() const { return warp != 0 || weft != 0; }
};

/// Membrane of constant strain (St. Venant-Kirchhoff). It knows its rest state by lengths alone.
struct MembraneTriangle {
  std::array<int, 3> vertices;         ///< counter-clockwise from outside
  std::array<double, 3> rest_lengths;  ///< [m] of the edges opposite them; > 0 and a triangle with area
  double lambda, mu;                   ///< Lame parameters of the plane [N/m]; mu >= 0, lambda + mu >= 0
  Threads threads = {};                ///< none: the same in all directions
};

/// Which part of the second derivative of an energy counts: the Hessian itself, which is indefinite where
/// springs are compressed or hinges bent; a semidefinite part of it (springs without the transverse part of
/// compressed ones; see each element); or what lies between.
struct Stiffness {
  double clamped;  ///< share of the way from the Hessian to the semidefinite part [-]; in [0, 1]
  /// An energy may couple fewer particles than its Hessian does, and answer with something spectrally near:
  /// for searches, whose end does not depend on it. As many blocks, and where, each time.
  bool narrow = false;
  static const Stiffness exact, positive_part;
  bool operator==(const Stiffness&) const = default;
};
inline constexpr Stiffness Stiffness::exact{0}, Stiffness::positive_part{1};

/// Takes what one element adds to the block of the stiffness matrix K [N/m] in the rows of particle i and the
/// columns of particle j. K is the second derivative of the energy, so forces change by -K u.
using BlockSink = std::function<void(int i, int j, const Mat3& block)>;

class PackedEnergy;  // packed_energy.h

/// A caller's own energy or force on a cloth: put into Cloth::energies it counts wherever elements do. Each
/// function is called once a pass, with one position a particle [m] in the order of Cloth::particles; it must
/// not change the object, and may be called by one thread after another.
/// \details Equal arguments must give equal results, or runs do not repeat. What each part of the library
/// asks:
///  - simulate: forces. It gets no dashpots of its own. Implicit steps do not see how the force changes
///    where there is no stiffness, and take more iterations. XPBD refuses it: it knows constraints alone.
///  - The limit of a step: the positive part of the stiffness, or, without, differences of forces.
///  - settle: energy and forces; without stiffness Newton's method does not see how the force changes: the
///    same rest, by more iterations.
///  - certify refuses an energy without stiffness; prestress refuses any (it has no rest state to change).
///  - A saved state's fingerprint counts how many energies there are, and cannot tell one from another.
class Energy {
 public:
  virtual ~Energy() = default;

  /// E at x [J].
  virtual double energy(std::span<const Vec3> x) const = 0;

  /// Adds the forces -dE/dx [N]. A force that has no energy may do so, too, in simulate(); settle() compares
  /// energies and stops where they do not fit.
  virtual void add_forces(std::span<const Vec3> x, std::span<Vec3> force) const = 0;

  /// Both in one pass, for callers that need both: adds the forces and returns E.
  virtual double add_energy_and_forces(std::span<const Vec3> x, std::span<Vec3> force) const {
    add_forces(x, force);
    return energy(x);
  }

  /// The same energy for callers that keep particles at places of their own, place[i] of particle i, in
  /// vectors of four; null: there is none, and they ask add_forces().
  virtual std::shared_ptr<const PackedEnergy> packed(std::span<const int> /*place*/) const { return nullptr; }

  /// Hands out the blocks of K = d2E/dx2 [N/m] as add_stiffness() of elements.h does: both (i, j) and (j, i),
  /// in a sequence of (i, j) that never changes; semidefinite with Stiffness::positive_part. Returns false,
  /// with nothing handed out, if there is none.
  virtual bool add_stiffness(std::span<const Vec3> /*x*/, Stiffness, const BlockSink&) const { return false; }
};

class ContactTerm;  // base/contact_term.h, which is not installed
struct Cloth;

/// Makes a contact for one search for rest, or for the implicit steps of one motion, on a cloth whose
/// particles it sees in the search's order. stiffness: a scale for its push [N/m].
using ContactMaker = std::function<std::unique_ptr<ContactTerm>(const Cloth& cloth, double stiffness)>;

/// A particle that is no cloth and rides on a triangle of it: a button's, an inner side's. It has no mass, so
/// that nothing moves it but place_riders() (riders.h), which settle() and simulate() call.
struct Rider {
  int particle;
  std::array<int, 3> triangle;  ///< particles that are not riders
  Vec3 weights;                 ///< of these, for the point that it is off from; sum 1 [-]
  Vec3 offset;                  ///< from there, in the triangle's frame [m]
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
  std::vector<std::shared_ptr<const Energy>> energies = {};  ///< a caller's own; none is null
  std::vector<Rider> riders = {};
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

/// Where strain is measured: structural springs and tension; without any of them the membrane's edges, an
/// inner one counting once a triangle.
std::vector<Spring> measured_edges(const Cloth& cloth);

/// |l - L| / L over springs; all 0 without springs.
struct StrainStatistics {
  double max = 0, p99 = 0, mean = 0;  ///< [-]; p99: 99 % of the springs are strained at most so much
};
StrainStatistics strain_statistics(std::span<const Vec3> x, std::span<const Spring> springs);
/// Of the measured edges.
StrainStatistics strain_statistics(const Cloth& cloth);

/// Sum of 1/2 m v^2 [J] over the particles that are not pinned.
double kinetic_energy(const Particles& particles);

}  // namespace furrow::physics
