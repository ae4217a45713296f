// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/columns.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/mesh/attribute_register.h"
#include "geometry/mesh/vertex_attributes.h"

namespace furrow::python {

using namespace geometry;

/// The corners of a face in the order of F and of PLY files: of each the halfedge that ends there.
std::array<Halfedge, 3> corners_of(const Mesh& mesh, Face f) {
  const Halfedge h = mesh.halfedge(f);
  return {h, mesh.next(h), mesh.next(mesh.next(h))};
}

Doubles numbers_of(py::handle given, const std::string& what) {
  const Doubles numbers = Doubles::ensure(given);
  if (!numbers) throw py::type_error(what + ": must be an array of numbers");
  return numbers;
}

py::array read_only(py::array array) {
  array.attr("flags").attr("writeable") = false;
  return array;
}

namespace {

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
  const Doubles numbers = numbers_of(given, std::string(c.words()) + " column '" + name + "'");
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

}  // namespace

void bind_columns(py::module_& module) {
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
}

}  // namespace furrow::python
