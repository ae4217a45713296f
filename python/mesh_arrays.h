// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "python/values.h"

namespace furrow::python {

/// Adds furrow._furrow.Mesh and Columns: a mesh whose positions and attributes are numpy arrays that lie in
/// it.
void bind_mesh(py::module_& module);

}  // namespace furrow::python
