// SPDX-License-Identifier: MIT
#pragma once
/// The overloads of all kinds of elements, for visitors of for_each_kind() (elements.h lists them).
#include <type_traits>

#include "physics/cloth/cloth.h"
#include "physics/cloth/hinge_forces.h"
#include "physics/cloth/membrane.h"
#include "physics/cloth/spring_forces.h"
#include "physics/cloth/tension_forces.h"

namespace furrow::physics {

/// The kind of an array that for_each_kind() hands out.
template <class Elements>
using KindOf = typename std::remove_cvref_t<Elements>::value_type;

}  // namespace furrow::physics
