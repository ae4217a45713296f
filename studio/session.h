// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <atomic>
#include <chrono>
#include <optional>
#include <string>

#include "jobs/play_sketch.h"
#include "jobs/sketch.h"
#include "studio/message.h"
#include "studio/outbox.h"
#include "studio/project.h"

namespace furrow::studio {

/// The drawing, and what each message does to it. All of it runs in one thread, but for cancel().
class Session : jobs::Listener {
 public:
  /// A new drawing in the folder, or the one that is there (Project). Throws as jobs::open_sketch(), and as
  /// Project.
  Session(const jobs::SceneInput& scene, const std::filesystem::path& folder, Outbox& out);
  /// Goes on with a project.
  Session(const std::filesystem::path& folder, Outbox& out);

  /// Sends all that a page shows to one that has just come.
  void greet(Client client);
  /// Another page may draw now.
  void leave(Client client);
  /// Does it, and answers `done` or `refused`; nothing is thrown for what the message asks.
  void handle(Client client, const Message& message);
  /// The job that runs ends soon, without effect; a play is paused. From any thread.
  void cancel() { cancelled_ = true; }
  /// Before each message. From any thread.
  void allow() { cancelled_ = false; }

 private:
  void progress(const std::string& what, double share) override;
  void warn(const jobs::Warning& warning) override { told_.push_back(warning.text); }
  bool cancelled() override { return cancelled_; }
  bool allows(const std::string&) override { return playing_; }

  Json done(const Message& message);
  void draw(const Json& body);
  Json set(const Json& body);
  void remove(const Json& body);
  void mirror(const Json& body);
  void choose_fabric(const Json& body);
  void hold(const Json& body);
  Json drape();
  Json play(const Json& body);
  Json fit(const Json& body);
  void show_moving(double time, const std::vector<float>& positions);
  void undo(bool again);
  void change(const std::string& what, Json drawing);
  void take_up(const Json& drawing);
  void show_now();
  Json status() const;
  Json& line_of(Json& drawing, const Json& body) const;
  std::string free_name(const std::string& word) const;
  /// "word-3": no mesh in the project's folder is called so.
  std::string free_name_of_file(const std::string& word) const;

  Outbox& out_;
  Client pen_ = everybody;  ///< the page that draws; everybody: the next one that asks
  std::optional<Project> project_;
  jobs::Sketch sketch_;
  std::atomic<bool> cancelled_ = false;
  bool playing_ = false;           ///< until somebody stops it: it may take as long as it likes
  std::vector<std::string> told_;  ///< by the job that runs
  Bytes cloth_, body_;             ///< as they are shown
  std::chrono::steady_clock::time_point progress_told_ = {}, moving_shown_ = {};
};

}  // namespace furrow::studio
