// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <stdexcept>
#include <string>

namespace furrow::geometry {

/// Thrown when the content of a mesh, stroke or scene cannot be used (not when an option is out of its range:
/// that is std::invalid_argument). The message says what, where, and what to do. The program exits with 3.
struct ContentError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace furrow::geometry
