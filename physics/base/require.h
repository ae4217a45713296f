// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace furrow::physics {

/// Throws std::invalid_argument: the operation, ": " and the parts, each as a stream shows it.
template <typename... Parts>
[[noreturn]] void refuse(std::string_view operation, const Parts&... parts) {
  std::ostringstream text;
  text << operation << ": ";
  (text << ... << parts);
  throw std::invalid_argument(text.str());
}

/// An option's precondition: returns if the value is good and finite, else throws std::invalid_argument with
/// "settle: gap = -1.000000 is not > 0". For an option that may be infinite, give std::min(value, 1e300).
/// \param range Completes "is not": "> 0", "in [0, 6]", "finite".
inline void require(std::string_view operation, std::string_view option, double value, bool good,
                    std::string_view range) {
  if (good && std::isfinite(value)) return;
  refuse(operation, option, " = ", std::to_string(value), " is not ", range);
}

}  // namespace furrow::physics
