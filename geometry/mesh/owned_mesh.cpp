// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/owned_members.h"

namespace furrow::geometry {

template class Owned<Mesh>;

}  // namespace furrow::geometry
