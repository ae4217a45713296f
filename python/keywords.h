// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <type_traits>

#include "python/listener.h"

/// The keyword arguments of jobs: a row each, from which the call, its docstring and its stub are made. Names
/// are those of the command line's flags, with underscores.
namespace furrow::python {

/// What Python is told of a keyword.
struct KeywordWords {
  std::string name, type;  ///< type as a stub has it, without None
  std::string help;
};

/// One keyword, and how its value reaches the job.
template <class Job>
struct Keyword {
  KeywordWords words;
  std::function<void(const Value&, Job&)> set;
};

template <class T>
std::string type_text() {
  if constexpr (std::is_same_v<T, double>) return "float";
  if constexpr (std::is_same_v<T, int>) return "int";
  if constexpr (std::is_same_v<T, bool>) return "bool";
  if constexpr (std::is_same_v<T, std::string>) return "str";
  if constexpr (std::is_same_v<T, std::filesystem::path>) return "Path";
  if constexpr (std::is_same_v<T, jobs::MeshInput>) return "Mesh | Path";
  if constexpr (std::is_same_v<T, jobs::StrokeInput>) return "Strokes";
  if constexpr (requires { typename T::value_type; } && !std::is_same_v<T, std::string> &&
                !std::is_same_v<T, std::filesystem::path>) {
    using Item = typename T::value_type;
    const std::string item = type_text<Item>();
    return std::is_same_v<T, std::vector<Item>> ? item + " | Sequence[" + item + "]" : item;
  }
}

/// A field of the job, of the type that it has: [](auto& job) -> auto& { return job.field; }.
template <class Job, class At>
Keyword<Job> row(const char* name, const char* help, At at) {
  using Field = std::remove_cvref_t<decltype(at(std::declval<Job&>()))>;
  return {{name, type_text<Field>(), help}, [at](const Value& value, Job& job) { take(value, at(job)); }};
}

template <class Job, class Word, class At>
Keyword<Job> choice(const char* name, const char* help, std::vector<std::pair<std::string, Word>> words,
                    At at) {
  std::string list;
  for (const auto& [word, value] : words) list += (list.empty() ? "\"" : ", \"") + word + "\"";
  const auto set = [words, list, at](const Value& value, Job& job) {
    std::string given;
    if (is_text(value.given)) take(value, given);
    for (const auto& [word, meant] : words)
      if (word == given) return void(at(job) = meant);
    value.fail("one of " + list);
  };
  return {{name, "Literal[" + list + "]", help}, set};
}

template <class Job>
Keyword<Job> own(const char* name, const char* type, const char* help,
                 std::function<void(const Value&, Job&)> set) {
  return {{name, type, help}, std::move(set)};
}

template <class Job>
using Keywords = std::vector<Keyword<Job>>;

/// A call of a job: its keywords, of which None counts as not given, and who listens.
class Call {
 public:
  Call(py::dict keywords, py::object on_warning);

  PythonListener listener;
  jobs::Frame frame;  ///< of keywords unit and up

  /// Those that the rows know are set in the job.
  template <class Job>
  void apply(const Keywords<Job>& rows, Job& job) {
    for (const auto& [name, given] : given_)
      for (const Keyword<Job>& row : rows)
        if (row.words.name == name) {
          used_.insert(name);
          row.set(Value{name, given}, job);
        }
  }
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

template <class Job>
std::vector<KeywordWords> words_of(const Keywords<Job>& rows, unsigned subcommand = 0) {
  std::vector<KeywordWords> words;
  for (const auto& row : rows) words.push_back(row.words);
  for (auto& list :
       {subcommand ? setting_keywords(subcommand) : std::vector<KeywordWords>{}, common_keywords()})
    words.insert(words.end(), list.begin(), list.end());
  return words;
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

/// A share in (0, 1): 0.01, or "1%".
void take_share(const Value& value, double& target);

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
