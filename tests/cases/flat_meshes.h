// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>

#include "physics/cloth/cloth.h"

namespace furrow::cases {

/// Meshes of flat sheets in the plane z = 0, as cloths: positions, triangles (counter-clockwise seen from
/// +z), and for each edge one structural spring of stiffness 0, at rest as it lies. Masses are density
/// [kg/m^2] times a third of the triangles around. There are no bending springs, membranes or hinges.

/// Rows of triangles with the horizontal edge h = width/columns, `rows` rows of equal height, every other row
/// shifted by h/2 and filled up with a half edge at both ends. jitter: each interior vertex moves by up to
/// jitter h in x and y, uniformly; then the mesh is made Delaunay by flips. columns, rows >= 1; jitter in
/// [0, 0.3]. Throws std::invalid_argument.
physics::Cloth triangular_sheet(double width, double height, int columns, int rows, double density = 0.1,
                                double jitter = 0, std::uint64_t seed = 1);
/// As many rows as make the triangles nearest to equilateral.
int equilateral_rows(double width, double height, int columns);

/// A hexagon around the origin with two corners on the x axis, of rings of equilateral triangles. Turns by 60
/// degrees leave it the same, except for jitter, which is as above. rings >= 1. Throws std::invalid_argument.
physics::Cloth hexagon(double half_diagonal, int rings, double density = 0.1, double jitter = 0,
                       std::uint64_t seed = 1);

/// A disc around the origin: its middle and `rings` rings at equal distances h = radius / rings, the k-th of
/// round(2 pi k) particles. Each ring is turned a little against its neighbours so that no direction is
/// preferred. Particles are ordered by rings from the middle, counter-clockwise in each. rings >= 1. Throws
/// std::invalid_argument.
physics::Cloth disc(double radius, int rings, double density = 0.1);

/// columns x rows rectangles with their diagonals; alternating: every other diagonal runs the other way.
physics::Cloth right_sheet(double width, double height, int columns, int rows, double density = 0.1,
                           bool alternating = false);

/// The same with diagonals that alternate from row to row.
physics::Cloth row_sheet(double width, double height, int columns, int rows, double density = 0.1);
/// right_sheet whose interior vertices move by up to 0.3 cells in x and y, except where a triangle would lose
/// nine tenths of its area; no edge is flipped.
physics::Cloth jittered_right_sheet(double width, double height, int columns, int rows, double density = 0.1,
                                    std::uint64_t seed = 1);
/// A Delaunay triangulation of points that keep 0.75 of the mean distance from each other (blue noise), with
/// columns x rows edges on the border.
physics::Cloth blue_noise_sheet(double width, double height, int columns, int rows, double density = 0.1,
                                std::uint64_t seed = 1);
/// right_sheet with a slanted line of vertices inserted through its middle, a fifth of a cell apart, and made
/// Delaunay.
physics::Cloth lined_sheet(double width, double height, int columns, int rows, double density = 0.1);

/// The kinds of meshes that bending is measured on.
enum class SheetKind {
  one_diagonal,
  by_row,
  union_jack,
  equilateral,
  jittered,
  cut_jittered,
  blue_noise,
  lined
};
inline constexpr SheetKind sheet_kinds[] = {
    SheetKind::one_diagonal, SheetKind::by_row,       SheetKind::union_jack, SheetKind::equilateral,
    SheetKind::jittered,     SheetKind::cut_jittered, SheetKind::blue_noise, SheetKind::lined};
const char* name_of(SheetKind kind);
/// width x height, `columns` cells along x; rows to fit.
physics::Cloth sheet_of(SheetKind kind, double width, double height, int columns, double density = 0.1);

/// A membrane triangle of plane stress, nu = 0.3 by default, for each triangle; at rest as the cloth lies.
void add_flat_membrane(physics::Cloth& cloth, double young_times_thickness, double poisson = 0.3);

/// A linear hinge for each interior edge, flat at rest, for the bending rigidity [N m]. at_clamp: whether a
/// particle lies on a clamped edge. A hinge between two such particles counts twice (it stands for half a
/// cell).
void add_flat_hinges(physics::Cloth& cloth, double rigidity, const std::vector<char>& at_clamp = {});

/// For each edge a < b the apexes of its one or two triangles, sorted by (a, b).
struct EdgeApexes {
  int a, b;
  int left, right;  ///< on either side of a -> b; -1: none
};
std::vector<EdgeApexes> edges_of(const std::vector<std::array<int, 3>>& triangles);

}  // namespace furrow::cases
