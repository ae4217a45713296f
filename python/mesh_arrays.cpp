// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/mesh_arrays.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <set>

#include "geometry/mesh/attribute_register.h"
#include "geometry/mesh/vertex_attributes.h"
#include "io/mesh/soup_to_mesh.h"

namespace furrow::python {
namespace {

using namespace geometry;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// The columns of one kind of element: 'v', 'f', 'e', or 'h', the corners of faces.
struct Columns {
  py::object owner;
  char kind;

  HeldMesh& held() const { return py::cast<HeldMesh&>(owner); }
  Mesh& mesh() const { return held().file.mesh; }
  const char* words() const {
    return kind == 'v' ? "vertex" : kind == 'f' ? "face" : kind == 'e' ? "edge" : "corner";
  }
};

/// The corners of a face in the order of F and of PLY files: of each the halfedge that ends there.
std::array<Halfedge, 3> corners_of(const Mesh& mesh, Face f) {
  const Halfedge h = mesh.halfedge(f);
  return {h, mesh.next(h), mesh.next(mesh.next(h))};
}

/// Numbers that a value of an attribute is made of.
template <class T>
struct Layout {
  static constexpr py::ssize_t size = 1;
  using Number = T;
};
template <std::size_t n>
struct Layout<std::array<double, n>> {
  static constexpr py::ssize_t size = py::ssize_t(n);
  using Number = double;
};
template <>
struct Layout<Vector> {
  static constexpr py::ssize_t size = 3;
  using Number = double;
};
static_assert(sizeof(Vector) == 3 * sizeof(double) && sizeof(Point) == 3 * sizeof(double));

template <class Number>
std::vector<py::ssize_t> shape_of(py::ssize_t count, py::ssize_t size) {
  return size == 1 ? std::vector<py::ssize_t>{count} : std::vector<py::ssize_t>{count, size};
}

py::array read_only(py::array array) {
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// Values that lie in memory as an array: seen where they are.
template <class K, class V>
py::array view(const py::object& owner, Map<K, V> map, std::size_t count) {
  using L = Layout<V>;
  const auto shape = shape_of<typename L::Number>(py::ssize_t(count), L::size);
  if (count == 0) return py::array_t<typename L::Number>(shape);
  return py::array_t<typename L::Number>(shape, reinterpret_cast<typename L::Number*>(&map[K(0)]), owner);
}
/// Truth values lie as bits: a copy.
template <class K>
py::array view(const py::object&, Map<K, bool> map, std::size_t count) {
  py::array_t<bool> array({py::ssize_t(count)});
  for (std::size_t i = 0; i < count; ++i)
    array.mutable_at(py::ssize_t(i)) = map[K(K(0).idx() + typename K::size_type(i))];
  return read_only(array);
}
/// Of halfedges, those of corners: a copy, m x 3 (x 2).
template <class V>
py::array corner_array(const Mesh& mesh, Map<Halfedge, V> map) {
  using L = Layout<V>;
  std::vector<py::ssize_t> shape{py::ssize_t(mesh.number_of_faces()), 3};
  if (L::size > 1) shape.push_back(L::size);
  py::array_t<double> array(shape);
  double* to = array.mutable_data();
  for (const Face f : mesh.faces())
    for (const Halfedge h : corners_of(mesh, f)) {
      const double* from = reinterpret_cast<const double*>(&map[h]);
      to = std::copy_n(from, L::size, to);
    }
  return read_only(array);
}

template <class K>
std::size_t count_of(const Mesh& mesh) {
  if constexpr (std::is_same_v<K, Vertex>) return mesh.number_of_vertices();
  if constexpr (std::is_same_v<K, Face>) return mesh.number_of_faces();
  if constexpr (std::is_same_v<K, Edge>) return mesh.number_of_edges();
  return 3 * mesh.number_of_faces();
}

/// Calls for each attribute of the register of this kind.
template <class Visit>
void for_each_attribute(char kind, const Visit& visit) {
  std::apply([&](const auto&... a) { ((a.name[0] == kind ? visit(a) : void()), ...); }, attribute_register);
}

std::vector<std::string> names_of(const Columns& c) {
  std::vector<std::string> names;
  for_each_attribute(c.kind, [&](const auto& a) {
    if (find_map(c.mesh(), a)) names.push_back(a.name + 2);
  });
  if (c.kind == 'v')
    for (const VertexAttribute& a : vertex_attributes(c.mesh())) names.push_back(a.name);
  return names;
}

py::object get(const Columns& c, const std::string& name) {
  py::object found;
  for_each_attribute(c.kind, [&](const auto& a) {
    using K = typename std::remove_cvref_t<decltype(a)>::Key;
    if (name != a.name + 2) return;
    const auto map = find_map(c.mesh(), a);
    if (!map) return;
    if constexpr (std::is_same_v<K, Halfedge>)
      found = corner_array(c.mesh(), *map);
    else
      found = view(c.owner, *map, count_of<K>(c.mesh()));
  });
  if (!found && c.kind == 'v')
    for (const VertexAttribute& a : vertex_attributes(c.mesh()))
      if (a.name == name) found = view(c.owner, a.values, c.mesh().number_of_vertices());
  if (!found) throw py::key_error("no " + std::string(c.words()) + " column '" + name + "'");
  return found;
}

/// What is wrong with a number of a column, as the PLY reader would say; "": nothing.
const char* fault_of(PlyValue kind, double x) {
  const bool unset = std::isnan(x);
  switch (kind) {
    case PlyValue::color:
      return x >= 0 && x <= 1 ? "" : "must be in [0, 1]";
    case PlyValue::index:
      return x >= -1 && x < 2147483647 && x == std::floor(x) ? "" : "must be whole and at least -1";
    case PlyValue::count:
      return x >= 0 && x <= 1e6 && x == std::floor(x) ? "" : "must be whole, 0 to 1e6";
    case PlyValue::flag:
      return x == 0 || x == 1 ? "" : "must be True or False";
    case PlyValue::length:
      return unset || (x > 0 && std::isfinite(x)) ? "" : "must be above 0, or NaN";
    case PlyValue::mass:
    case PlyValue::stiffness:
      return unset || (x >= 0 && std::isfinite(x)) ? "" : "must be at least 0, or NaN";
    case PlyValue::angle:
      return unset || std::fabs(x) <= M_PI ? "" : "must be in [-pi, pi], or NaN";
    default:
      return unset || std::isfinite(x) ? "" : "must be finite, or NaN";
  }
}

/// The numbers of `given`, of the column's shape. Throws std::invalid_argument for another shape or number.
Doubles checked(const Columns& c, const std::string& name, const py::handle given,
                const std::vector<py::ssize_t>& shape, PlyValue kind) {
  const Doubles numbers = Doubles::ensure(given);
  if (!numbers) throw py::error_already_set();
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument(std::string(c.words()) + " column '" + name + "': " + what);
  };
  if (std::vector<py::ssize_t>(numbers.shape(), numbers.shape() + numbers.ndim()) != shape) {
    std::string words;
    for (const py::ssize_t n : shape) words += (words.empty() ? "" : " x ") + std::to_string(n);
    fail("must have the shape " + words);
  }
  for (py::ssize_t i = 0; i < numbers.size(); ++i)
    if (const char* fault = fault_of(kind, numbers.data()[i]); *fault)
      fail(std::string(fault) + ", not " + std::to_string(numbers.data()[i]) + " (number " +
           std::to_string(i) + ")");
  return numbers;
}

template <class V>
void put(V& target, const double* from) {
  if constexpr (std::is_same_v<V, Vector>)
    target = Vector(from[0], from[1], from[2]);
  else if constexpr (Layout<V>::size > 1)
    std::copy_n(from, Layout<V>::size, target.begin());
  else
    target = static_cast<V>(*from);
}

template <class A>
void set_known(const Columns& c, const std::string& name, const A& a, py::handle given) {
  using K = typename A::Key;
  using V = typename A::Value;
  Mesh& mesh = c.mesh();
  const py::ssize_t size = Layout<V>::size;
  std::vector<py::ssize_t> shape{py::ssize_t(count_of<K>(mesh))};
  if (std::is_same_v<K, Halfedge>) shape = {py::ssize_t(mesh.number_of_faces()), 3};
  if (size > 1) shape.push_back(size);
  const Doubles numbers = checked(c, name, given, shape, a.ply.value);
  auto map = ensure_map(mesh, static_cast<const PropertyName<K, V>&>(a));
  const double* from = numbers.data();
  if constexpr (std::is_same_v<K, Halfedge>) {
    for (const Face f : mesh.faces())
      for (const Halfedge h : corners_of(mesh, f)) put(map[h], std::exchange(from, from + size));
  } else {
    for (std::size_t i = 0; i < count_of<K>(mesh); ++i) {
      V value{a.default_value};
      put(value, std::exchange(from, from + size));
      map[K(typename K::size_type(i))] = value;
    }
  }
}

void set(const Columns& c, const std::string& name, py::handle given) {
  bool known = false;
  for_each_attribute(c.kind, [&](const auto& a) {
    if (name != a.name + 2) return;
    known = true;
    set_known(c, name, a, given);
  });
  if (known) return;
  std::string names;
  for_each_attribute(c.kind,
                     [&](const auto& a) { names += (names.empty() ? "" : ", ") + std::string(a.name + 2); });
  if (c.kind != 'v')
    throw py::key_error("no " + std::string(c.words()) + " column '" + name + "'; there may be " + names);
  if (name.empty() || name.find_first_of(" \t\r\n") != std::string::npos)
    throw std::invalid_argument("vertex column '" + name + "': a name has no white space");
  const std::size_t n = c.mesh().number_of_vertices();
  const Doubles numbers = checked(c, name, given, {py::ssize_t(n)}, PlyValue::none);
  auto map = ensure_vertex_attribute(c.mesh(), name);
  for (std::size_t i = 0; i < n; ++i) map[Vertex(Mesh::size_type(i))] = numbers.data()[i];
}

// ---- the mesh

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
    if (!any) throw py::error_already_set();
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
  const Doubles v = Doubles::ensure(positions);
  if (!v) throw py::error_already_set();
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
  const Doubles v = Doubles::ensure(given);
  if (!v) throw py::error_already_set();
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

std::string repr(const HeldMesh& held) {
  const Mesh& mesh = held.file.mesh;
  return "<furrow.Mesh" + (held.name.empty() ? "" : " '" + held.name + "'") + ": " +
         std::to_string(mesh.number_of_vertices()) + " vertices, " + std::to_string(mesh.number_of_faces()) +
         " faces>";
}

}  // namespace

void bind_mesh(py::module_& module) {
  py::class_<Columns>(module, "Columns")
      .def("__getitem__", get)
      .def("__setitem__", set)
      .def("__contains__",
           [](const Columns& c, const std::string& name) {
             const auto names = names_of(c);
             return std::find(names.begin(), names.end(), name) != names.end();
           })
      .def("__len__", [](const Columns& c) { return names_of(c).size(); })
      .def("__iter__", [](const Columns& c) { return py::iter(py::cast(names_of(c))); })
      .def("keys", names_of)
      .def("__repr__", [](const Columns& c) {
        return "<" + std::string(c.words()) +
               " columns: " + py::cast<std::string>(py::str(py::cast(names_of(c)))) + ">";
      });
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
                               return h.file.mesh.number_of_vertices()
                                          ? reinterpret_cast<std::uintptr_t>(&h.file.mesh.point(Vertex(0)))
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
      .def("__repr__", repr);
}

}  // namespace furrow::python
