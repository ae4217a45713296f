// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "python/keywords.h"

/// What jobs on meshes alone share.
namespace furrow::python {

/// The name of a mesh in memory, or of its file.
inline std::string name_of(py::handle mesh) {
  if (py::isinstance<HeldMesh>(mesh)) return py::cast<const HeldMesh&>(mesh).name;
  return std::filesystem::path(py::cast<std::string>(py::str(mesh))).stem().string();
}

/// Sets the job's keywords and its frame.
template <class Job>
void take_keywords(Call& call, Job& job) {
  call.apply(keywords_of(card(job)));
  call.require_all_used(words_of_card<Job>());
  job.frame = call.frame;
}

inline void note_written(Json& report, const std::filesystem::path& file) {
  if (!file.empty()) report["written"] = file.string();
}

}  // namespace furrow::python
