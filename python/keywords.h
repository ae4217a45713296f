// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "jobs/base/card.h"
#include "python/listener.h"

/// The keyword arguments of jobs: a row each, from which the call, its docstring and its stub are made. Names
/// are those of the command line's flags, with underscores. Those of a job's card (jobs/base/card.h) need no
/// more.
namespace furrow::python {

/// What Python is told of a keyword.
struct KeywordWords {
  std::string name, type;  ///< type as a stub has it, without None
  std::string help;
};

/// One keyword, and how its value reaches the job.
struct Keyword : KeywordWords {
  std::function<void(const Value&)> set;
};
using Keywords = std::vector<Keyword>;

/// A keyword for each row of a job's card, which set the fields that it is bound to.
Keywords keywords_of(const std::vector<jobs::CardRow>& card);

/// A call of a job: its keywords, of which None counts as not given, and who listens.
class Call {
 public:
  Call(py::dict keywords, py::object on_warning);

  PythonListener listener;
  jobs::Frame frame;  ///< of keywords unit and up

  /// Those that the rows know are set in the job.
  void apply(const Keywords& rows);
  bool has(const std::string& name) const { return bool(value(name)); }
  py::object value(const std::string& name) const;  ///< as it was given; null: it was not
  /// Sets what the settings of a scene know: the keywords of flags that the subcommand has (one of
  /// io::used_by), and `settings`, which has any of them.
  void apply_settings(unsigned subcommand, io::TomlDocument& document, Memory& memory);
  /// Throws TypeError for a keyword that nobody knew, with the nearest of `known`.
  void require_all_used(const std::vector<KeywordWords>& known) const;

 private:
  void add_pins(const Value& value, const std::string& kind, io::TomlDocument& document,
                Memory& memory) const;
  std::vector<std::pair<std::string, py::object>> given_;
  std::set<std::string> used_;
};

/// Those of all jobs, and those that settings of a scene give to the subcommand.
std::vector<KeywordWords> common_keywords();
std::vector<KeywordWords> setting_keywords(unsigned subcommand);

std::vector<KeywordWords> words_of(const Keywords& rows, unsigned subcommand = 0);
/// Of a job all of whose keywords are on its card.
template <class Job>
std::vector<KeywordWords> words_of_card(unsigned subcommand = 0) {
  Job job;
  return words_of(keywords_of(card(job)), subcommand);
}

/// A scene as a call names it: a mesh in memory or its file, a scene's file, a dict of settings, or None
/// beside a saved state; then what the keywords say over it.
struct CalledScene {
  jobs::SceneInput input;
  std::optional<io::SavedState> state;
  std::filesystem::path state_path;
  bool is_file = false;  ///< a .toml file
};
CalledScene called_scene(py::handle garment, unsigned subcommand, const std::filesystem::path& state,
                         Call& call);

/// The garment's file's name, without folder and ending.
std::string garment_name(const jobs::SceneInput& scene);

/// What a job comes to.
struct Outcome {
  Json report;
  std::vector<HeldMesh> meshes = {};
  std::vector<jobs::Warning> failures = {};  ///< why it is no success; empty: it is
  std::vector<jobs::Warning> warnings = {};  ///< about the result
  bool succeeded = true;
};

/// A job as Python calls it.
struct Runner {
  std::string name;
  std::vector<KeywordWords> keywords;
  std::function<Outcome(const py::list& inputs, Call& call)> run;
};
void add_scene_jobs(std::vector<Runner>& runners);
void add_rest_jobs(std::vector<Runner>& runners);
void add_mesh_jobs(std::vector<Runner>& runners);
void add_measure_jobs(std::vector<Runner>& runners);
void add_wrinkle(std::vector<Runner>& runners);

/// Runs the job without the interpreter's lock. Throws what a callable or Ctrl-C raised on the way.
template <class Job, class Run>
auto without_lock(const Job& job, Call& call, const Run& run) {
  try {
    const py::gil_scoped_release free;
    return run(job, static_cast<jobs::Listener&>(call.listener));
  } catch (const physics::Cancelled&) {
    call.listener.rethrow();
    throw;
  }
}

}  // namespace furrow::python
