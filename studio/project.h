// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "jobs/inputs.h"

namespace furrow::studio {

using jobs::Json;

/// A step of the history: what it was, in words, and the whole drawing after it.
struct Step {
  std::string what;
  Json drawing;  ///< {"settings": ..., "lines": [{"on": true, "stroke": {...}}, ...]}
};

/// A studio's folder: project.json, log.jsonl, and history/ with a file a step, so that undo has no limit and
/// memory does not grow. Each intention that changed something is a line of the log. Each file is written
/// beside its place and renamed, so a killed program loses at most the step that it was at. Nothing outside
/// the folder is touched.
class Project {
 public:
  /// Opens the folder, or makes it with this first step. `opened_with` tells one start from another; a folder
  /// that was made with another one is refused; what pages have sent lies in "files", which may be there.
  /// Throws std::invalid_argument for a folder that is there and no project, std::runtime_error for one that
  /// cannot be written.
  Project(std::filesystem::path folder, const Json& opened_with, const Step& first);
  /// Opens one that is there.
  explicit Project(std::filesystem::path folder);
  static bool is_there(const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_; }
  const Step& now() const { return now_; }
  std::size_t at() const { return at_; }        ///< steps that can be undone
  std::size_t count() const { return count_; }  ///< of the history, with those undone

  /// Adds a step after the present one, in place of those undone. `did`: what asked for it, for the log.
  void add(const Step& step, const Json& did);
  /// Goes to a step and returns what the step that is left, or entered, was.
  std::string undo();
  std::string redo();
  /// The first step, and all that was asked for since then and changed something: what replays the project.
  Step first() const { return read_step(0); }
  std::vector<Json> log() const;
  /// What that step would be called; "": there is none.
  std::string next_undo() const { return at_ > 0 ? now_.what : ""; }
  std::string next_redo() const { return redo_what_; }
  /// What the steps from this one on were, those undone with them. Cost: a file each.
  std::vector<std::string> names_from(std::size_t first) const;

  /// The present step's frame, if it was kept: that of the latest steps is.
  std::optional<std::string> frame() const;
  void keep_frame(const std::string& bytes);

 private:
  std::filesystem::path step_file(std::size_t step) const;
  std::filesystem::path frame_file(std::size_t step) const;
  Step read_step(std::size_t step) const;
  void write_state() const;
  void go_to(std::size_t step);
  void drop_undone();
  void write_log(const Json& line);

  std::filesystem::path folder_;
  Json opened_with_;
  std::size_t at_ = 0, count_ = 1;
  std::uintmax_t logged_ = 0;  ///< bytes of the log; what stands behind them belongs to a step that was lost
  Step now_;
  std::string redo_what_;
};

}  // namespace furrow::studio
