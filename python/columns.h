// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <pybind11/numpy.h>

#include <array>
#include <string>

#include "geometry/mesh/mesh.h"
#include "python/values.h"

namespace furrow::python {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The columns of one kind of element: 'v', 'f', 'e', or 'h', the corners of faces.
struct Columns {
  py::object owner;
  char kind;

  HeldMesh& held() const { return py::cast<HeldMesh&>(owner); }
  geometry::Mesh& mesh() const { return held().file.mesh; }
  const char* words() const {
    return kind == 'v' ? "vertex" : kind == 'f' ? "face" : kind == 'e' ? "edge" : "corner";
  }
};

/// The corners of a face in the order of F and of PLY files: of each the halfedge that ends there.
std::array<geometry::Halfedge, 3> corners_of(const geometry::Mesh& mesh, geometry::Face f);

/// An array of doubles; throws TypeError, naming `what`, for what is none.
Doubles numbers_of(py::handle given, const std::string& what);

/// The array, which nobody may write to any more.
py::array read_only(py::array array);

/// Adds furrow._furrow.Columns: a mapping from names to arrays.
void bind_columns(py::module_& module);

}  // namespace furrow::python
