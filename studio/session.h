// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "jobs/sketch/play_sketch.h"
#include "jobs/sketch/sketch.h"
#include "jobs/sketch/sketch_parts.h"
#include "studio/message.h"
#include "studio/outbox.h"
#include "studio/project.h"

namespace furrow::studio {

/// The drawing, and what each message does to it. All of it runs in one thread, but for cancel().
class Session : jobs::Listener {
 public:
  /// A new drawing in the folder, or the one that is there (Project). `made_for`: body that the garment lies
  /// about, if that of the scene is to wear it. Throws as jobs::open_sketch() and check_made_for(), and as
  /// Project.
  Session(const jobs::SceneInput& scene, const std::filesystem::path& folder, Outbox& out,
          const std::filesystem::path& made_for = {});
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
  /// Who plays pulls at the cloth from now on, or lets it go; at another time nothing happens. From any
  /// thread; answers as handle() does.
  void pull(Client client, const Message& message);
  /// Whether the page draws, or nobody does.
  bool may_command(Client client) const { return pen_ == everybody || pen_ == client; }
  /// The shape that is shown, to the last bit.
  std::string shape_bits();
  const Project& project() const { return *project_; }

 private:
  using Does = Json (Session::*)(const Json& body);
  static const std::map<std::string, Does>& intentions();

  void progress(const std::string& what, double share) override;
  /// That lines were lost is told first.
  void warn(const jobs::Warning& warning) override {
    const bool lost = warning.code == "lines_lost";
    lost_ = lost_ || lost;
    told_.insert(lost ? told_.begin() : told_.end(), warning.text);
  }
  bool cancelled() override { return cancelled_; }
  bool allows(const std::string&) override { return playing_; }

  Json done(const Message& message);
  // Lines (line_intentions.cpp)
  Json draw(const Json& body);
  Json set(const Json& body);
  Json remove(const Json& body);
  Json duplicate(const Json& body);
  Json mirror(const Json& body);
  Json move(const Json& body);
  Json set_middle(const Json& body);
  Json tell_points(const Json& body);
  // The cloth (cloth_intentions.cpp)
  Json choose_fabric(const Json& body);
  Json blow(const Json& body);
  Json hold(const Json& body);
  Json pin(const Json& body);
  Json attach(const Json& body);
  Json drape(const Json& body);
  Json touch(const Json& body);
  Json keep(const Json& body);
  Json play(const Json& body);
  Json fit(const Json& body);
  Json weigh(const Json& body);
  Json find_tangles(const Json& body);
  // All of it
  Json undo(const Json& body);
  Json redo(const Json& body);
  Json save(const Json& body);
  Json give(const Json& body);
  Json give_animation(const std::string& as);
  Json show(const Json& body);
  Json tell_history(const Json& body);

  void change(const std::string& what, Json drawing);
  void change_pins(const std::string& what, Json pins);
  /// The mesh that a job made takes the garment's place, under such a file name.
  void take_result(const std::string& word, const std::string& what, const io::MeshFile& file, Json motion);
  void go(bool again);
  /// What a drawing needs to be the one that is shown, made before a step is recorded.
  struct Prepared;
  Prepared prepare(const Json& drawing, std::optional<std::string> frame);
  void take(Prepared prepared) noexcept;
  void open_present();
  void note_unkept(const std::string& why);
  /// Refuses what needs the cloth on its body, while it lies about the one that it was made for.
  void require_brought(const std::string& what) const;
  void show_all();
  void show_body();
  Bytes moved_body();
  void show_preview(const Json& drawing);
  void show_moving(double time, const std::vector<float>& positions);
  void show_moving_body(const std::vector<float>& positions);
  void begin_play(bool on);
  std::optional<jobs::Grip> present_grip();
  Json status() const;
  Json& line_of(Json& drawing, const Json& body) const;
  double middle() const;
  /// "word-3": no mesh in the project's folder is called so.
  std::string free_name_of_file(const std::string& word) const;

  Outbox& out_;
  std::atomic<Client> pen_ = everybody;  ///< the page that draws; everybody: the next one that asks
  std::optional<Project> project_;
  jobs::Sketch sketch_;
  double middle_of_sketch_ = 0;  ///< jobs::middle_of() it [m]
  std::vector<jobs::SketchPart> parts_of_sketch_;
  std::atomic<bool> cancelled_ = false;
  bool playing_ = false;           ///< until somebody stops it: it may take as long as it likes
  Json did_;                       ///< the intention that is being done, as the log will have it
  std::vector<std::string> told_;  ///< by the job that runs
  std::shared_ptr<jobs::BodyShelf> shelf_ = jobs::make_shelf();
  bool lost_ = false;        ///< lines, by what it told
  bool recorded_ = false;    ///< a step, for the message that is being handled
  Bytes cloth_, body_;       ///< as they are shown
  Bytes shown_body_;         ///< that all pages have
  bool body_moved_ = false;  ///< since it was shown so
  std::mutex grip_mutex_;
  std::optional<jobs::Grip> grip_;  ///< that a page asks for
  std::chrono::steady_clock::time_point progress_told_ = {}, moving_shown_ = {}, body_shown_ = {};
};

}  // namespace furrow::studio
