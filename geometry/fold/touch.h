// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/mesh_fwd.h"

namespace furrow::geometry {

/// What a hand does to cloth that rests.
enum class TouchKind {
  iron,   ///< takes out folds that are narrower than the touch is wide; what is wider stays
  steam,  ///< lets the cloth keep the shape that it has
  pinch,  ///< draws the cloth together
  pull    ///< moves it, and leaves it there
};
/// The word of each in files, and what it is called in a list.
const char* word_of(TouchKind kind);

struct Touch {
  TouchKind kind = TouchKind::iron;
  Coordinates<Point> at = {};   ///< on the cloth [m]
  double radius = 0.1;          ///< in which it works [m]; > 0, finite
  double strength = 1;          ///< share that is done in the middle; of a pinch, that goes; in (0, 1]
  Coordinates<Vector> by = {};  ///< way of a pull [m]; finite
};

/// How much a touch takes hold of each vertex, by index: 1 in the inner half of its radius, falling smoothly
/// to 0 at the radius. Only cloth that ways along edges join to the vertex nearest to `at`; a sleeve beside
/// the body's cloth is left alone. Throws std::invalid_argument for a number out of its range, or where no
/// vertex with a face is within the radius; and as check_mesh(). O(half-edges).
std::vector<double> touch_weights(const Mesh& mesh, const Touch& touch);

/// Does it to shape and rest state. `weights`: of touch_weights(). Ironing and pulling move vertices: rest
/// lengths, springs and struts go along (apply_rest_rule()), so that strain stays, and hinges keep what bends
/// them as far as their bend is kept. Steam moves nothing, and takes rest lengths, springs and angles to
/// those of the shape, as far as weight and strength say. A pinch moves nothing and shortens lengths alone,
/// to 1 - strength of them in the middle (less of it where triangles are too thin). Stiffnesses, masses and
/// connectivity stay, and all bits where the weight is 0. Unset lengths and angles count as the shape lies.
/// What balances afterwards is for physics to say. Throws as touch_weights() and check_mesh(), the mesh
/// untouched. Cost: a sparse factor of the patch.
///
/// \details Ironing solves (M + t L' M^-1 L) x = M x0 within 1.75 times the radius, L the Laplacian by the
/// cotangents of the cloth as it lies, M its areas, t = (1.4 radius / pi)^4, and adds what the same makes of
/// the rest, x0 - x, twice (Tukey's twicing): waves of twice the radius keep half their height, half as long
/// ones a twentieth, and twice as long ones lose a hundredth, so that ironing often hardly shrinks a sleeve.
/// Within a radius of the cloth's borders t falls to 0, and what lies on them stays: cloth that ends freely
/// would flare. Sources: M. Desbrun et al., "Implicit fairing of irregular meshes", SIGGRAPH 1999; J. Tukey,
/// "Exploratory data analysis", 1977.
void apply_touch(Mesh& mesh, const Touch& touch, const std::vector<double>& weights);

}  // namespace furrow::geometry
