// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "jobs/base/project_files.h"

namespace furrow::studio {

using jobs::Json;

/// A step of the history: what it was, in words, and the whole drawing after it.
struct Step {
  std::string what;
  Json drawing;  ///< {"settings": ..., "lines": [{"on": true, "stroke": {...}}, ...]}
};

/// A studio's folder: project.json, log.jsonl, and history/ with a file a step, so that undo has no limit and
/// memory does not grow. Each intention that changed something is a line of the log. A step is there from the
/// moment that project.json, which is replaced last, says so; until then nothing is changed, on disk or here,
/// so a function that throws, or a program that is killed, leaves the history as it was. Nothing outside the
/// folder is touched, whatever lies in it. One program at a time has it, others may read it.
class Project {
 public:
  enum class Access { read, write };

  /// Opens the folder, or makes it with this first step. `opened_with` tells one start from another; a folder
  /// that was made with another one is refused; what pages have sent lies in "files", which may be there.
  /// Throws std::invalid_argument for a folder that is there and no project, std::runtime_error for one that
  /// cannot be written or that another studio has, geometry::ContentError for one that is damaged.
  Project(std::filesystem::path folder, const Json& opened_with, const Step& first);
  /// Opens one that is there.
  explicit Project(std::filesystem::path folder, Access access = Access::write);
  static bool is_there(const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_; }
  const Step& now() const { return now_; }
  std::size_t at() const { return state_.at; }        ///< steps that can be undone
  std::size_t count() const { return state_.count; }  ///< of the history, with those undone

  /// Adds a step after the present one, in place of those undone. `did`: what asked for it, for the log.
  void add(const Step& step, const Json& did);
  /// The step that undo(), or redo(), would go to. Throws geometry::ContentError for one that is damaged.
  Step before() const { return read_step(at() - 1); }
  Step after() const { return read_step(at() + 1); }
  /// Goes to a step and returns what the step that is left, or entered, was.
  std::string undo();
  std::string redo();
  /// The first step, and all that was asked for since then and changed something: what replays the project.
  Step first() const { return read_step(0); }
  std::vector<Json> log() const;
  /// What that step would be called; "": there is none.
  std::string next_undo() const { return at() > 0 ? now_.what : ""; }
  std::string next_redo() const { return redo_what_; }
  /// What the steps from this one on were, those undone with them. Cost: a file each.
  std::vector<std::string> names_from(std::size_t first) const;

  /// A step's frame, if it was kept and can be read: that of the latest steps is.
  std::optional<std::string> frame(std::size_t step) const;
  /// Keeps that of the present step; returns why it cannot be kept, which harms nothing; "": it is.
  std::string keep_frame(const std::string& bytes) noexcept;

 private:
  /// What project.json says.
  struct State {
    std::size_t at = 0, count = 1;
    std::uintmax_t logged = 0;  ///< bytes of the log; what stands behind them belongs to a step that was lost
    std::optional<std::size_t> fresh =
        std::nullopt;  ///< step whose file may still have the name of a new one
  };
  void lock();
  void begin(const Json& opened_with, const Step& first);
  std::filesystem::path step_file(std::size_t step, const char* ending = ".json") const;
  Step read_step(std::size_t step) const;
  State read_state(const Json& json) const;
  void write_state(const State& state) const;
  void commit(State next, const Json& did);
  void go_to(std::size_t step, const char* word);
  void settle();
  void drop_undone(std::size_t count) noexcept;

  std::filesystem::path folder_;
  std::unique_ptr<jobs::FolderLock> lock_;
  Json opened_with_;
  State state_;
  Step now_;
  std::string redo_what_;
};

}  // namespace furrow::studio
