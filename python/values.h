// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <pybind11/pybind11.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "jobs/base/inputs.h"
#include "jobs/chain/wrinkle.h"

/// Values of Python as those of jobs, and back. All throw std::invalid_argument, naming the keyword, for a
/// value of another type.
namespace furrow::python {

namespace py = pybind11;
using jobs::Json;

/// A mesh as Python holds it.
struct HeldMesh {
  io::MeshFile file;
  std::string name;  ///< of its file without ending, or as it was called; ""
};

/// A report as dicts and lists. Numbers are finite (jobs/base/finite_report.h).
py::object to_python(const Json& json);

/// A value as a keyword gave it.
struct Value {
  const std::string& keyword;
  py::handle given;

  [[noreturn]] void fail(const std::string& wanted) const;  ///< "friction: must be a number, not 'a'"
};

/// Meshes and strokes that a call gave as objects, under the names that settings mention.
class Memory {
 public:
  explicit Memory(jobs::MemoryFiles& files) : files_(files) {}
  std::string add(const HeldMesh& mesh, const std::string& usual);
  std::string add(std::vector<io::DrawnStroke> strokes, const std::string& usual);

 private:
  std::string unused(const std::string& name) const;
  jobs::MemoryFiles& files_;
};

/// What JSON has a place for, paths and numpy's numbers and arrays among it; meshes and lists of strokes go
/// into the memory.
Json to_json(const Value& value, Memory& memory);

/// A list of strokes: dicts with the keys of a stroke file (docs/strokes.md).
std::vector<io::DrawnStroke> strokes_of(const Value& value);

bool is_text(py::handle value);  ///< a str or a path
void take(const Value& value, double& target);
void take(const Value& value, int& target);
void take(const Value& value, bool& target);
void take(const Value& value, std::string& target);
void take(const Value& value, std::filesystem::path& target);
void take(const Value& value, jobs::MeshInput& target);
void take(const Value& value, jobs::StrokeInput& target);

template <class T>
void take(const Value& value, std::optional<T>& target) {
  T taken{};
  take(value, taken);
  target = std::move(taken);
}
/// A list, or a single one.
template <class T>
void take(const Value& value, std::vector<T>& target) {
  target.clear();
  const bool is_list = py::isinstance<py::list>(value.given) || py::isinstance<py::tuple>(value.given);
  if (!is_list) take(value, target.emplace_back());
  if (!is_list) return;
  for (const py::handle item : value.given) take(Value{value.keyword, item}, target.emplace_back());
}

}  // namespace furrow::python
