// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace furrow::geometry {

/// A strut (struts.h) no longer than this at rest is a tie [m]: it holds two vertices at one place, whatever
/// the shape, so displacement leaves it as it is. Above 0, as springs need, and far below any load's.
constexpr double tie_length = 1e-9;

}  // namespace furrow::geometry
