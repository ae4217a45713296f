// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/mesh_arrays.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <set>
#include <sstream>

#include "io/mesh/soup_to_mesh.h"
#include "python/columns.h"

namespace furrow::python {
namespace {

using namespace geometry;
using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// Rows of corners into the soup: an array m x k, or a list of polygons.
void add_faces(py::handle faces, io::PolygonSoup& soup) {
  const auto add = [&](const std::int64_t* from, py::ssize_t n) {
    for (py::ssize_t i = 0; i < n; ++i) {
      if (from[i] < 0) throw std::invalid_argument("F: an index is negative: " + std::to_string(from[i]));
      soup.corners.push_back(std::size_t(from[i]));
    }
    soup.close_face();
  };
  const auto whole = [](py::handle given) {
    const py::array any = py::array::ensure(given);
    if (!any) throw py::type_error("F: must be an array of whole numbers");
    if (any.size() > 0 && any.dtype().kind() != 'i' && any.dtype().kind() != 'u')
      throw std::invalid_argument("F: must hold whole numbers, the indices of vertices");
    return Indices(any);
  };
  const bool is_array = py::isinstance<py::array>(faces);
  bool is_ragged = !is_array;
  if (!is_array) {
    std::set<std::size_t> sizes;
    for (const py::handle face : faces) sizes.insert(py::len(face));
    is_ragged = sizes.size() > 1;
  }
  if (is_ragged) {
    for (const py::handle face : faces) {
      const Indices row = whole(face);
      add(row.data(), row.size());
    }
    return;
  }
  const Indices rows = whole(faces);
  if (rows.ndim() != 2 || rows.shape(1) < 3)
    throw std::invalid_argument("F: must be m x 3, m x 4, or a list of polygons");
  for (py::ssize_t f = 0; f < rows.shape(0); ++f) add(rows.data(f, 0), rows.shape(1));
}

/// Warns, as the readers of files do, of what had to be mended.
void tell_repairs(const io::RepairReport& r, const std::string& name) {
  std::string text;
  const auto tell = [&](std::size_t n, const char* what) {
    if (n) text += (text.empty() ? "" : ", ") + std::to_string(n) + what;
  };
  tell(r.degenerate_faces, " degenerate faces dropped");
  tell(r.duplicate_faces, " duplicate faces dropped");
  tell(r.reversed_faces, " faces turned to agree with their neighbours");
  tell(r.duplicated_vertices, " vertices duplicated where the surface was not manifold");
  if (!text.empty()) py::module_::import("furrow").attr("_repaired")(name + ": " + text, name);
}

HeldMesh mesh_of(py::handle positions, py::handle faces, const std::string& name) {
  const Doubles v = numbers_of(positions, "V");
  if (v.ndim() != 2 || v.shape(1) != 3) throw std::invalid_argument("V: must be n x 3");
  io::PolygonSoup soup;
  for (py::ssize_t i = 0; i < v.shape(0); ++i) {
    const double* p = v.data(i, 0);
    if (!std::isfinite(p[0] + p[1] + p[2]))
      throw std::invalid_argument("V: position " + std::to_string(i) + " is not finite");
    soup.points.emplace_back(p[0], p[1], p[2]);
  }
  add_faces(faces, soup);
  const std::string called = name.empty() ? "mesh" : name;
  io::SoupMesh made = io::soup_to_mesh(soup, called);
  tell_repairs(made.repairs, called);
  HeldMesh held;
  held.file.mesh = std::move(made.mesh);
  held.file.repairs = made.repairs;
  held.name = name;
  return held;
}

py::array positions_of(const py::object& self) {
  Mesh& mesh = py::cast<HeldMesh&>(self).file.mesh;
  const std::size_t n = mesh.number_of_vertices();
  if (n == 0) return py::array_t<double>(std::vector<py::ssize_t>{0, 3});
  return py::array_t<double>({py::ssize_t(n), py::ssize_t(3)},
                             reinterpret_cast<double*>(&mesh.point(Vertex(0))), self);
}

void set_positions(HeldMesh& held, py::handle given) {
  Mesh& mesh = held.file.mesh;
  const Doubles v = numbers_of(given, "V");
  if (v.ndim() != 2 || v.shape(1) != 3 || std::size_t(v.shape(0)) != mesh.number_of_vertices())
    throw std::invalid_argument("V: must be " + std::to_string(mesh.number_of_vertices()) +
                                " x 3, as the mesh has vertices");
  for (py::ssize_t i = 0; i < v.size(); ++i)
    if (!std::isfinite(v.data()[i]))
      throw std::invalid_argument("V: position " + std::to_string(i / 3) + " is not finite");
  for (const Vertex u : mesh.vertices()) {
    const double* p = v.data(py::ssize_t(u.idx()), 0);
    mesh.point(u) = Point(p[0], p[1], p[2]);
  }
}

py::array faces_of(const HeldMesh& held) {
  const Mesh& mesh = held.file.mesh;
  py::array_t<std::int32_t> array({py::ssize_t(mesh.number_of_faces()), py::ssize_t(3)});
  std::int32_t* to = array.mutable_data();
  for (const Face f : mesh.faces())
    for (const Halfedge h : corners_of(mesh, f)) *to++ = std::int32_t(mesh.target(h).idx());
  return read_only(array);
}

py::array edges_of(const HeldMesh& held) {
  const Mesh& mesh = held.file.mesh;
  py::array_t<std::int32_t> array({py::ssize_t(mesh.number_of_edges()), py::ssize_t(2)});
  std::int32_t* to = array.mutable_data();
  for (const Edge e : mesh.edges())
    for (int i = 0; i < 2; ++i) *to++ = std::int32_t(mesh.vertex(e, unsigned(i)).idx());
  return read_only(array);
}

py::dict repairs_of(const HeldMesh& held) {
  const io::RepairReport& r = held.file.repairs;
  py::dict dict;
  dict["triangulated_faces"] = r.triangulated_faces;
  dict["degenerate_faces"] = r.degenerate_faces;
  dict["duplicate_faces"] = r.duplicate_faces;
  dict["reversed_faces"] = r.reversed_faces;
  dict["duplicated_vertices"] = r.duplicated_vertices;
  dict["isolated_vertices"] = r.isolated_vertices;
  dict["merged_vertices"] = r.merged_vertices;
  return dict;
}

/// A mesh for another process: its PLY, which keeps all columns, and its name.
py::tuple pickled(const HeldMesh& held) {
  std::ostringstream out;
  io::write_mesh(out, io::MeshFormat::ply, held.file);
  return py::make_tuple(py::bytes(out.str()), held.name);
}
HeldMesh unpickled(const py::tuple& state) {
  std::istringstream in(py::cast<std::string>(state[0]));
  return {io::read_mesh(in, io::MeshFormat::ply, "mesh"), py::cast<std::string>(state[1])};
}

std::string repr(const HeldMesh& held) {
  const Mesh& mesh = held.file.mesh;
  return "<furrow.Mesh" + (held.name.empty() ? "" : " '" + held.name + "'") + ": " +
         std::to_string(mesh.number_of_vertices()) + " vertices, " + std::to_string(mesh.number_of_faces()) +
         " faces>";
}

}  // namespace

void bind_mesh(py::module_& module) {
  bind_columns(module);
  const auto columns = [](char kind) {
    return [kind](const py::object& self) { return Columns{self, kind}; };
  };
  py::class_<HeldMesh>(module, "Mesh")
      .def(py::init(&mesh_of), py::arg("V"), py::arg("F"), py::kw_only(), py::arg("name") = "")
      .def_property("V", positions_of, set_positions)
      .def_property_readonly("F", faces_of)
      .def_property_readonly("E", edges_of)
      .def_property_readonly("vertex", columns('v'))
      .def_property_readonly("face", columns('f'))
      .def_property_readonly("edge", columns('e'))
      .def_property_readonly("corner", columns('h'))
      .def_property_readonly("repairs", repairs_of)
      .def_property_readonly("_address",
                             [](HeldMesh& h) {
                               return h.file.mesh->number_of_vertices()
                                          ? reinterpret_cast<std::uintptr_t>(&h.file.mesh->point(Vertex(0)))
                                          : 0;
                             })
      .def_property(
          "group_names", [](HeldMesh& h) { return h.file.group_names; },
          [](HeldMesh& h, std::vector<std::string> names) { h.file.group_names = std::move(names); })
      .def_property(
          "material_names", [](HeldMesh& h) { return h.file.material_names; },
          [](HeldMesh& h, std::vector<std::string> names) { h.file.material_names = std::move(names); })
      .def_readwrite("name", &HeldMesh::name)
      .def("copy", [](const HeldMesh& h) { return h; })
      .def("__copy__", [](const HeldMesh& h) { return h; })
      .def("__deepcopy__", [](const HeldMesh& h, const py::dict&) { return h; })
      .def(py::pickle([](const HeldMesh& h) { return pickled(h); },
                      [](const py::tuple& state) { return unpickled(state); }))
      .def("__repr__", repr);
}

}  // namespace furrow::python
