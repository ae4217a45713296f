// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "io/mesh/mesh_file.h"
#include "io/scene/scene.h"
#include "io/scene/state_file.h"
#include "io/stroke/stroke_file.h"

/// What users ask for, as functions of structs: `Report job(const Job&, Listener&)`. Nothing here prints or
/// exits; what a job has to say, it says to its listener and in its report. Several jobs may run in one
/// process at once, each with a listener of its own. This header: what jobs take (garments, strokes and
/// scenes in memory or by path, the frame of their files), and who listens.
namespace furrow::jobs {

/// What is no error, and hardly what was meant.
struct Warning {
  std::string code;   ///< stable, for programs: "lines_after_end"
  std::string text;   ///< a whole sentence for people; names file and remedy, too
  std::string where;  ///< the file or setting that it is about; "": the result
  std::string help;   ///< the option or setting that helps; "": none
};

/// Told how a job goes on, in the thread that runs it. By default it wants to hear nothing.
class Listener {
 public:
  virtual ~Listener() = default;
  /// `share` of `what` is done, in [0, 1]; 1 is told at its end, also where it was broken off. Must not
  /// throw.
  virtual void progress(const std::string& /*what*/, double /*share*/) {}
  virtual void warn(const Warning&) {}
  /// Asked often. true: the job ends within half a second (garments of up to 30,000 vertices; larger ones
  /// take as much longer), and leaves no output half written.
  virtual bool cancelled() { return false; }
  /// Whether that is the user's wish, not a budget's end: a search then stays with the mesh that it has.
  virtual bool cancelled_by_user() { return cancelled(); }
  /// Asked where a job would take more memory or time than is likely meant; `demand` says how much. true: it
  /// goes on all the same. false: it throws, and says so.
  virtual bool allows(const std::string& /*demand*/) { return false; }
  /// Asked where an output is a file that is there and that does not look as if furrow had written it. true:
  /// it is replaced. false: the job throws std::invalid_argument before it begins.
  virtual bool replaces(const std::string& /*path*/) { return false; }
};

/// Passes on nothing but whether the other one cancels, and what it allows.
class SilentListener : public Listener {
 public:
  explicit SilentListener(Listener& other) : other_(other) {}
  bool cancelled() override { return other_.cancelled(); }
  bool cancelled_by_user() override { return other_.cancelled_by_user(); }
  bool allows(const std::string& demand) override { return other_.allows(demand); }
  bool replaces(const std::string& path) override { return other_.replaces(path); }

 private:
  Listener& other_;
};

/// A stretch of work that a listener sees: its progress, and its end with the scope.
class ProgressScope {
 public:
  ProgressScope(Listener& listener, std::string what) : listener_(listener), what_(std::move(what)) {}
  ~ProgressScope() { listener_.progress(what_, 1); }
  ProgressScope(const ProgressScope&) = delete;
  ProgressScope& operator=(const ProgressScope&) = delete;
  /// Reports the share that is done, or the largest so far where a search begins again; returns whether to go
  /// on.
  bool operator()(double share) const {
    most_ = std::max(most_, share);
    listener_.progress(what_, most_);
    return !listener_.cancelled();
  }

 private:
  Listener& listener_;
  std::string what_;
  mutable double most_ = 0;
};

/// Unit and upward axis of the files that a job reads and writes.
struct Frame {
  /// "m", "cm", "mm" or "inch"; "y" or "z". None: what a file notes of itself, else the noted ones below.
  std::optional<std::string> unit, up;
  std::string noted_unit = "m", noted_up = "y";  ///< what an input notes, for files that note none

  /// The unit and the axis that hold.
  std::string unit_in_use() const { return unit.value_or(noted_unit); }
  std::string up_in_use() const { return up.value_or(noted_up); }
};

/// A path by which something is found: "./a/../b", "b" and "/here/b" are one, as they name one place. Links
/// are not looked up.
class PathKey {
 public:
  PathKey(const std::filesystem::path& path)
      : place_(path.empty() ? path : std::filesystem::absolute(path).lexically_normal()) {}
  PathKey(const std::string& path) : PathKey(std::filesystem::path(path)) {}
  PathKey(const char* path) : PathKey(std::filesystem::path(path)) {}
  auto operator<=>(const PathKey& other) const = default;

 private:
  std::filesystem::path place_;
};

struct BodyShelf;  ///< (jobs/body/world_body.h)

/// What a job has in memory in place of files: settings name it as if it were one. Keys are paths as the
/// program would open them; metres, y up.
struct MemoryFiles {
  std::map<PathKey, io::MeshFile> meshes = {};
  std::map<PathKey, std::vector<io::DrawnStroke>> strokes = {};
  std::shared_ptr<BodyShelf> shelf =
      {};  ///< keeps the body that was loaded last; null: each job loads it anew

  bool holds(const PathKey& path) const { return meshes.count(path) || strokes.count(path); }
  const io::MeshFile* find_mesh(const PathKey& path) const {
    const auto found = meshes.find(path);
    return found == meshes.end() ? nullptr : &found->second;
  }
};

using Json = nlohmann::ordered_json;

struct CardRow;  ///< an option of a job (jobs/base/card.h)

/// What every step of a job is given: the frame of its files, who listens, and what is in memory.
struct Context {
  Frame frame;
  Listener& listener;
  const MemoryFiles* memory = nullptr;  ///< null: all is in files

  void warn(std::string code, std::string text, std::string where = "", std::string help = "") const {
    listener.warn({std::move(code), std::move(text), std::move(where), std::move(help)});
  }
};

/// A mesh in memory (metres, y up), or the file that it is read from. A path may also name one of
/// Context::memory.
using MeshInput = std::variant<std::filesystem::path, io::MeshFile>;

/// A scene as a job is given it.
struct SceneInput {
  io::TomlDocument settings;     ///< docs/scenes.md; io::read_toml(), io::set_value()
  std::filesystem::path folder;  ///< that the paths in the settings' file are relative to
  MemoryFiles memory = {};       ///< in place of files
};

/// The scene of a file. Throws as io::read_toml().
SceneInput scene_from_file(const std::filesystem::path& toml);

}  // namespace furrow::jobs
