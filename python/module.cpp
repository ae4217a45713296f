// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>

#include "furrow/version.h"
#include "geometry/mesh/errors.h"
#include "jobs/base/finite_report.h"
#include "jobs/base/read_inputs.h"
#include "jobs/mesh/info.h"
#include "physics/base/progress.h"
#include "python/keywords.h"
#include "python/mesh_arrays.h"

/// furrow._furrow: what the package `furrow` (python/src/furrow) is made of.
namespace furrow::python {
namespace {

const std::vector<Runner>& runners() {
  static const std::vector<Runner> list = [] {
    std::vector<Runner> runners;
    add_wrinkle(runners);
    add_scene_jobs(runners);
    add_rest_jobs(runners);
    add_mesh_jobs(runners);
    add_measure_jobs(runners);
    return runners;
  }();
  return list;
}

const Runner& runner_of(const std::string& name) {
  for (const Runner& runner : runners())
    if (runner.name == name) return runner;
  throw std::invalid_argument("there is no job '" + name + "'");
}

py::list told(const std::vector<jobs::Warning>& warnings) {
  py::list list;
  for (const jobs::Warning& w : warnings)
    list.append(py::make_tuple(w.code, in_python(w.text), in_python(w.where), in_python(w.help)));
  return list;
}

/// Vertices and faces are counted from 0 without gaps, as arrays want them.
HeldMesh compact(HeldMesh mesh) {
  if (mesh.file.mesh->has_garbage()) mesh.file.mesh->collect_garbage();
  return mesh;
}

/// Runs a job: (report, meshes, failures, whether it succeeded).
py::tuple run(const std::string& job, const py::list& inputs, const py::dict& keywords,
              const py::object& warn) {
  Call call(keywords, warn);
  Outcome outcome = runner_of(job).run(inputs, call);
  for (const jobs::Warning& w : outcome.warnings) call.listener.warn(w);
  call.listener.rethrow();
  py::list meshes;
  for (HeldMesh& mesh : outcome.meshes) meshes.append(py::cast(compact(std::move(mesh))));
  return py::make_tuple(to_python(report_in_python(jobs::finite_report(std::move(outcome.report)))), meshes,
                        told(outcome.failures), outcome.succeeded);
}

/// (name, type, help) of each keyword of a job.
py::list keywords(const std::string& job) {
  py::list list;
  for (const KeywordWords& k : runner_of(job).keywords) list.append(py::make_tuple(k.name, k.type, k.help));
  return list;
}

HeldMesh read_mesh(py::handle path, const py::dict& keywords, const py::object& warn) {
  Call call(keywords, warn);
  call.require_all_used(common_keywords());
  std::filesystem::path from;
  take(Value{"path", path}, from);
  const jobs::Context context{call.frame, call.listener};
  HeldMesh mesh = without_lock(from, call, [&](const std::filesystem::path& file, jobs::Listener&) {
    return HeldMesh{jobs::read_mesh(file, context), file.stem().string()};
  });
  call.listener.rethrow();
  return compact(std::move(mesh));
}

void write_mesh(const HeldMesh& mesh, py::handle path, const py::dict& keywords, const py::object& warn) {
  Call call(keywords, warn);
  call.require_all_used(common_keywords());
  std::filesystem::path to;
  take(Value{"path", path}, to);
  jobs::write_mesh(to, mesh.file, {call.frame, call.listener});
  call.listener.rethrow();
}

py::object info(const HeldMesh& mesh) { return to_python(jobs::finite_report(jobs::info(mesh.file))); }

/// Errors of the libraries as those of the package, with keywords in their messages; std::bad_alloc is
/// MemoryError by pybind11 itself.
void translate_errors(const py::object& errors) {
  static PyObject *content, *cancelled, *too_much;  // live as long as the interpreter
  content = py::object(errors["ContentError"]).release().ptr();
  cancelled = py::object(errors["Cancelled"]).release().ptr();
  too_much = py::object(errors["TooMuchWork"]).release().ptr();
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const geometry::ContentError& e) {
      PyErr_SetString(content, in_python(e.what()).c_str());
    } catch (const physics::Cancelled& e) {
      PyErr_SetString(cancelled, e.what());
    } catch (const physics::TooMuchWork& e) {
      PyErr_SetString(too_much, in_python(e.what()).c_str());
    } catch (const std::invalid_argument& e) {
      PyErr_SetString(PyExc_ValueError, in_python(e.what()).c_str());
    } catch (const py::builtin_exception&) {
      throw;
    } catch (const std::runtime_error& e) {
      PyErr_SetString(PyExc_RuntimeError, in_python(e.what()).c_str());
    }
  });
}

}  // namespace

PYBIND11_MODULE(_furrow, module) {
  bind_mesh(module);
  module.attr("version") = FURROW_VERSION;
  module.def("translate_errors", translate_errors);
  module.def("run", run);
  module.def("keywords", keywords);
  module.def("read_mesh", read_mesh);
  module.def("write_mesh", write_mesh);
  module.def("info", info);
}

}  // namespace furrow::python
