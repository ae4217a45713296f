// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <stdexcept>
#include <string>

namespace furrow::geometry {

/// Thrown when the content of a mesh, stroke, scene or file cannot be used (not when an option is out of its
/// range: that is std::invalid_argument). The message says what, where (for a text file, file and line), and
/// what to do. The program exits with 3. docs/library.md lists all that the libraries throw.
struct ContentError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace furrow::geometry
