// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace furrow::tests {

/// Tables of a scene: a patch of 0.1 m in the x-z plane hangs by its edge, of cloth that bears small folds.
/// The last one is [material].
inline const char* const hung_patch = R"([[pins]]
box = [-1, -1, 0.0499, 1, 1, 1]
[forces]
gravity = [0, 0, -9.81]
[material]
membrane = "triangles"
stretch = 100
bending_law = "hinge"
rigidity = 1e-4
)";

}  // namespace furrow::tests
