// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace furrow::cases {

inline constexpr double gravity = 9.81;  ///< m/s^2

}  // namespace furrow::cases
