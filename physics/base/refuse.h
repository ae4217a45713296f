// SPDX-License-Identifier: MIT
#pragma once
#include <sstream>
#include <stdexcept>

namespace furrow::physics {

/// Throws std::invalid_argument: "simulate: " and the parts, each as a stream shows it.
template <typename... Parts>
[[noreturn]] void refuse(const Parts&... parts) {
  std::ostringstream text;
  text << "simulate: ";
  (text << ... << parts);
  throw std::invalid_argument(text.str());
}

}  // namespace furrow::physics
