// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/values.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace furrow::python {
namespace {

std::string shown(py::handle value) {
  std::string text = py::repr(value);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

/// A number of numpy as one of Python; others as they are.
py::object plain(py::handle value) {
  const bool is_own = py::isinstance<py::str>(value) || py::isinstance<py::int_>(value) ||
                      py::isinstance<py::float_>(value) || py::isinstance<py::dict>(value);
  if (!is_own && py::hasattr(value, "tolist")) return value.attr("tolist")();
  return py::reinterpret_borrow<py::object>(value);
}

/// Whether it is a list of dicts that have what strokes have: it is no other setting.
bool is_strokes(const Value& value) {
  return value.keyword == "strokes" &&
         (py::isinstance<py::list>(value.given) || py::isinstance<py::tuple>(value.given));
}

Json dict_to_json(const Value& value, Memory& memory) {
  Json table = Json::object();
  for (const auto& [key, item] : py::reinterpret_borrow<py::dict>(value.given)) {
    if (!py::isinstance<py::str>(key)) value.fail("a dict whose keys are texts");
    const std::string name = py::cast<std::string>(key);
    table[name] = to_json({name, item}, memory);
  }
  return table;
}

}  // namespace

py::object to_python(const Json& json) {
  switch (json.type()) {
    case Json::value_t::boolean:
      return py::bool_(json.get<bool>());
    case Json::value_t::number_integer:
      return py::int_(json.get<std::int64_t>());
    case Json::value_t::number_unsigned:
      return py::int_(json.get<std::uint64_t>());
    case Json::value_t::number_float:
      return py::float_(json.get<double>());
    case Json::value_t::string: {
      const std::string& text = json.get_ref<const std::string&>();  // a file's name may be no UTF-8
      return py::reinterpret_steal<py::object>(
          PyUnicode_DecodeUTF8(text.data(), py::ssize_t(text.size()), "replace"));
    }
    case Json::value_t::array: {
      py::list list;
      for (const Json& item : json) list.append(to_python(item));
      return list;
    }
    case Json::value_t::object: {
      py::dict dict;
      for (const auto& [key, item] : json.items()) dict[py::str(key)] = to_python(item);
      return dict;
    }
    default:
      return py::none();
  }
}

void Value::fail(const std::string& wanted) const {
  throw std::invalid_argument(keyword + ": must be " + wanted + ", not " + shown(given));
}

std::string Memory::unused(const std::string& name) const {
  std::string free = name;
  for (int i = 2; files_.holds(free); ++i) free = name + "-" + std::to_string(i);
  return free;
}

std::string Memory::add(const HeldMesh& mesh, const std::string& usual) {
  const std::string name = unused(mesh.name.empty() ? usual : mesh.name);
  files_.meshes[name] = mesh.file;
  return name;
}

std::string Memory::add(std::vector<io::DrawnStroke> strokes, const std::string& usual) {
  const std::string name = unused(usual);
  files_.strokes[name] = std::move(strokes);
  return name;
}

Json to_json(const Value& value, Memory& memory) {
  if (py::isinstance<HeldMesh>(value.given))
    return memory.add(py::cast<const HeldMesh&>(value.given),
                      value.keyword == "mesh" ? "garment" : value.keyword);
  if (is_strokes(value)) return memory.add(strokes_of(value), "strokes");
  const py::object given = plain(value.given);
  if (given.is_none()) return nullptr;
  if (py::isinstance<py::bool_>(given)) return py::cast<bool>(given);
  if (py::isinstance<py::int_>(given)) {
    int overflow = 0;
    const long long number = PyLong_AsLongLongAndOverflow(given.ptr(), &overflow);
    if (overflow) value.fail("a smaller whole number");
    return std::int64_t(number);
  }
  if (py::isinstance<py::float_>(given)) return py::cast<double>(given);
  if (is_text(given)) {
    std::string text;
    take(Value{value.keyword, given}, text);
    return text;
  }
  if (py::isinstance<py::dict>(given)) return dict_to_json({value.keyword, given}, memory);
  if (!py::isinstance<py::list>(given) && !py::isinstance<py::tuple>(given))
    value.fail("a number, a text, a list or a dict");
  Json list = Json::array();
  for (const py::handle item : given) list.push_back(to_json({value.keyword, item}, memory));
  return list;
}

std::vector<io::DrawnStroke> strokes_of(const Value& value) {
  Json list = Json::array();
  jobs::MemoryFiles none;
  Memory memory(none);
  if (!py::isinstance<py::list>(value.given) && !py::isinstance<py::tuple>(value.given))
    value.fail("a list of strokes, each a dict, or the file that has them");
  for (const py::handle item : value.given) list.push_back(to_json({"stroke", item}, memory));
  if (list.empty()) value.fail("a list with a stroke");
  return io::drawn_strokes_from(Json{{"strokes", list}}.dump(), value.keyword);
}

bool is_text(py::handle value) { return py::isinstance<py::str>(value) || py::hasattr(value, "__fspath__"); }

void take(const Value& value, double& target) {
  const py::object given = plain(value.given);
  const bool is_number = py::isinstance<py::float_>(given) ||
                         (py::isinstance<py::int_>(given) && !py::isinstance<py::bool_>(given));
  if (!is_number) value.fail("a number");
  target = PyFloat_AsDouble(given.ptr());
  if (PyErr_Occurred()) PyErr_Clear(), value.fail("a smaller number");  // a whole one that no double holds
  if (std::isnan(target)) value.fail("a number");
}

void take(const Value& value, int& target) {
  const py::object given = plain(value.given);
  if (!py::isinstance<py::int_>(given) || py::isinstance<py::bool_>(given)) value.fail("a whole number");
  int overflow = 0;
  const long number = PyLong_AsLongAndOverflow(given.ptr(), &overflow);
  if (overflow || number != static_cast<int>(number)) value.fail("a smaller whole number");
  target = static_cast<int>(number);
}

void take(const Value& value, bool& target) {
  const py::object given = plain(value.given);
  if (!py::isinstance<py::bool_>(given)) value.fail("True or False");
  target = py::cast<bool>(given);
}

void take(const Value& value, std::string& target) {
  if (!is_text(value.given)) value.fail("a text");
  PyObject* bytes = nullptr;
  if (!PyUnicode_FSConverter(value.given.ptr(), &bytes)) throw py::error_already_set();
  target = py::cast<std::string>(py::reinterpret_steal<py::bytes>(bytes));
}

void take(const Value& value, std::filesystem::path& target) {
  std::string text;
  if (!is_text(value.given)) value.fail("a path");
  take(value, text);
  target = text;
}

void take(const Value& value, jobs::MeshInput& target) {
  if (py::isinstance<HeldMesh>(value.given)) {
    target = py::cast<const HeldMesh&>(value.given).file;
    return;
  }
  if (!is_text(value.given)) value.fail("a furrow.Mesh or the path of one");
  std::filesystem::path path;
  take(value, path);
  target = path;
}

void take(const Value& value, jobs::StrokeInput& target) {
  if (!is_text(value.given)) {
    target = strokes_of(value);
    return;
  }
  std::filesystem::path path;
  take(value, path);
  target = path;
}

}  // namespace furrow::python
