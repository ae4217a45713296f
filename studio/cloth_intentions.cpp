// SPDX-License-Identifier: GPL-3.0-or-later
// What a page asks of the cloth: how it is held, what it is made of, and that it come to rest or move.
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "jobs/sketch/fit_sketch.h"
#include "jobs/sketch/keep_sketch.h"
#include "jobs/sketch/sketch_mass.h"
#include "jobs/sketch/sketch_pins.h"
#include "jobs/sketch/sketch_tangles.h"
#include "studio/drawing.h"
#include "studio/frame_bytes.h"
#include "studio/session.h"

namespace furrow::studio {
namespace {

constexpr std::size_t most_pulls = 200000;     // of one play
constexpr double nearest_pin = 0.05;           // [m]
constexpr std::size_t most_vertices = 200000;  // of a lasso

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f s", seconds);
  return text;
}

bool wanted(const Json& body) {
  const Json on = body.value("on", Json());
  if (!on.is_boolean()) throw Refused("on: is neither true nor false");
  return on == true;
}

std::array<double, 3> point_of(const Json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end() || !found->is_array() || found->size() != 3)
    throw Refused(std::string(key) + ": is three numbers");
  std::array<double, 3> point{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Json& x = (*found)[k];
    if (!x.is_number() || !(std::abs(x.get<double>()) < 1e6))
      throw Refused(std::string(key) + ": is three numbers");
    point[k] = x.get<double>();
  }
  return point;
}

std::vector<int> vertices_of(const Json& body) {
  const Json& list = body.at("vertices");
  if (!list.is_array() || list.empty() || list.size() > most_vertices)
    throw Refused("vertices: is no list of 1 to " + std::to_string(most_vertices) + " numbers of vertices");
  std::vector<int> vertices;
  for (const Json& v : list) {
    if (!v.is_number_unsigned() || v.get<std::uint64_t>() >= (std::uint64_t{1} << 30))
      throw Refused("vertices: is no list of numbers of vertices");
    vertices.push_back(v.get<int>());
  }
  return vertices;
}

/// A grip as it stands in a message, and in the log of a play; none: the hand lets go.
std::optional<jobs::Grip> grip_of(const Json& body) {
  if (!body.contains("vertex")) return std::nullopt;
  return jobs::Grip{int(index_of(body, "vertex", std::size_t{1} << 30)), point_of(body, "to")};
}

/// The hand of a play that is done again: the pulls of the first time, at the same times.
struct RecordedHand {
  std::vector<std::pair<double, std::optional<jobs::Grip>>> pulls;
  std::size_t next = 0;
  std::optional<jobs::Grip> now = std::nullopt;

  std::optional<jobs::Grip> at(double time) {
    while (next < pulls.size() && pulls[next].first <= time) now = pulls[next++].second;
    return now;
  }
};

RecordedHand recorded_hand(const Json& body) {
  RecordedHand hand;
  const Json& pulls = body.at("pulls");
  if (!pulls.is_array() || pulls.size() > most_pulls) throw Refused("pulls: is no list of pulls");
  for (const Json& pull : pulls) {
    if (!pull.is_object()) throw Refused("pulls: is no list of pulls");
    hand.pulls.emplace_back(number_of(pull, "time", 0, 1e6), grip_of(pull));
  }
  return hand;
}

/// Lets a motion be seen at a speed of its own: what is computed sooner waits, what is late does not.
class Pace {
 public:
  /// speed: of the motion over the clock's [-]; from: its time now [s].
  Pace(double speed, double from) : speed_(speed), from_(from) {}

  /// Until the motion may be at a time [s], or is stopped.
  void wait_for(double time, const std::atomic<bool>& stopped) {
    using namespace std::chrono_literals;
    const auto due = begun_ + std::chrono::duration<double>((time - from_) / speed_);
    const auto now = std::chrono::steady_clock::now();
    if (due + 50ms < now) {  // what it lost it does not make up for
      begun_ = now;
      from_ = time;
    }
    while (!stopped && std::chrono::steady_clock::now() < due)
      std::this_thread::sleep_until(
          std::min(due, std::chrono::duration<double>(5ms) + std::chrono::steady_clock::now()));
  }

 private:
  double speed_, from_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

/// A file that goes again if no step was recorded that names it.
class Tentative {
 public:
  Tentative(std::filesystem::path file, const bool& recorded) : file_(std::move(file)), recorded_(recorded) {}
  ~Tentative() {
    std::error_code none;
    if (!recorded_) std::filesystem::remove(file_, none);
  }
  Tentative(const Tentative&) = delete;
  Tentative& operator=(const Tentative&) = delete;
  const std::filesystem::path& path() const { return file_; }

 private:
  const std::filesystem::path file_;
  const bool& recorded_;
};

/// The state that a motion goes on from.
std::filesystem::path state_of(const Json& motion, const std::filesystem::path& folder) {
  const std::filesystem::path name = motion.at("state").get<std::string>();
  std::error_code none;
  if (name != name.filename() ||
      !std::filesystem::is_regular_file(std::filesystem::symlink_status(folder / name, none)))
    throw Refused(name.string() +
                  ", where the motion was paused, is no file of the project; undo, and play anew");
  return folder / name;
}

Json row_of_pull(double time, const std::optional<jobs::Grip>& grip) {
  Json row{{"time", time}};
  if (grip) row.update({{"vertex", grip->vertex}, {"to", grip->to}});
  return row;
}

}  // namespace

Json Session::choose_fabric(const Json& body) {
  Json drawing = project_->now().drawing;
  const std::string name = text_of(body, "name");
  drawing["settings"]["material"]["preset"] = name;
  change("choose " + name, std::move(drawing));
  return Json::object();
}

Json Session::blow(const Json& body) {
  Json drawing = project_->now().drawing;
  const std::array<double, 3> wind = point_of(body, "velocity");
  for (const double v : wind)
    if (std::abs(v) > 50) throw Refused("velocity: air moves by at most 50 m/s here");
  const bool calm = wind == std::array<double, 3>{};
  drawing["settings"]["forces"]["wind"] = wind;
  change(calm ? "calm the wind" : "change the wind", std::move(drawing));
  return Json::object();
}

void Session::change_pins(const std::string& what, Json pins) {
  Json drawing = project_->now().drawing;
  drawing["settings"]["pins"] = std::move(pins);
  drawing.erase("motion");  // whose pins are others
  change(what, std::move(drawing));
}

Json Session::hold(const Json& body) {
  const std::vector<jobs::SketchBorder> borders = jobs::borders_of(sketch_);
  std::size_t border = 0;
  if (body.contains("border"))
    border = index_of(body, "border", borders.size());
  else if (body.contains("at"))
    border = jobs::nearest_border(sketch_, point_of(body, "at"));
  else
    while (border + 1 < borders.size() && borders[border].name != "top") ++border;
  if (borders.empty()) throw Refused("the cloth is closed: it has no border to hold");
  const bool held = borders[border].held,
             on = body.contains("at") && !body.contains("on") ? !held : wanted(body);
  if (held == on) throw Refused(on ? "that border is held already" : "nothing holds that border");
  Json pins = jobs::with_border(sketch_, border, on);
  change_pins((on ? "hold border " : "let go of border ") + borders[border].name, std::move(pins));
  return Json::object();
}

Json Session::pin(const Json& body) {
  if (body.contains("vertices")) {
    const std::vector<int> vertices = vertices_of(body);
    const bool on = wanted(body);
    Json pins = jobs::with_vertices(sketch_, vertices, on);
    change_pins(on ? "hold what was encircled" : "let go of what was encircled", std::move(pins));
    return Json::object();
  }
  Json pins = jobs::with_vertex_toggled(sketch_, point_of(body, "at"), nearest_pin);
  change_pins("change a pin", std::move(pins));
  return Json::object();
}

Json Session::attach(const Json& body) {
  const std::size_t part = index_of(body, "part", parts_of_sketch_.size());
  const bool on = wanted(body);
  Json drawing = project_->now().drawing;
  const std::string& name = parts_of_sketch_[part].name;
  Json& garment = drawing["settings"]["garment"];
  garment = jobs::with_part(garment, name, on);
  drawing.erase("motion");  // which began with other cloth
  change((on ? "attach " : "free ") + name, std::move(drawing));
  return Json::object();
}

void Session::take_result(const std::string& word, const std::string& what, const io::MeshFile& file,
                          Json motion) {
  Json drawing = project_->now().drawing;
  const std::string name = free_name_of_file(word) + ".ply";
  const Tentative result(project_->folder() / name, recorded_);
  jobs::write_sketched(sketch_, file, result.path(), *this);
  take_as_garment(name, jobs::pins_after(sketch_, file), drawing);
  drawing.erase("motion");
  if (!motion.is_null()) drawing["motion"] = std::move(motion);
  change(what, std::move(drawing));
}

Json Session::drape(const Json&) {
  const jobs::SketchAtRest rest = jobs::drape_sketch(sketch_, strokes_on(project_->now().drawing), *this);
  take_result("rest", "drape", rest.file, nullptr);
  return {{"outcome", rest.outcome}, {"remarks", rest.remarks}, {"lost", lost_}};
}

Json Session::touch(const Json& body) {
  require_brought("touch");
  if (!strokes_on(project_->now().drawing).empty())
    throw Refused("touch: the lines that were drawn are not at rest yet; drape the cloth first");
  if (!body.contains("touch") || !body.at("touch").is_object()) throw Refused("touch: is no touch");
  const jobs::TouchedSketch touched = jobs::touch_sketch(sketch_, body.at("touch"), *this);
  take_result("touched", touched.kind, touched.file, nullptr);
  return {{"moved", touched.moved}, {"balances", touched.balances}, {"pairs", touched.crossings}};
}

void Session::require_brought(const std::string& what) const {
  if (project_->now().drawing.contains("made_for"))
    throw Refused(what +
                  ": the garment lies about the body that it was made for; drape it first, which "
                  "brings it to the one that is to wear it");
}

Json Session::keep(const Json&) {
  require_brought("keep");
  const jobs::KeptSketch kept = jobs::keep_sketch(sketch_, strokes_on(project_->now().drawing), *this);
  take_result("kept", "keep", kept.file, nullptr);
  Json lines = Json::array();
  for (const jobs::KeptSketchLine& line : kept.lines) {
    lines.push_back({{"name", line.name}, {"verdict", line.verdict}, {"words", line.words}});
    if (line.end) lines.back()["at"] = *line.end;
  }
  return {
      {"verdicts", lines}, {"all_hold", kept.all_hold}, {"legend", kept.legend}, {"remarks", kept.remarks}};
}

Json Session::play(const Json& body) {
  require_brought("play");
  const Json drawing = project_->now().drawing;
  const Json before = drawing.value("motion", Json::object());
  jobs::PlayRequest request;
  request.seconds =
      body.contains("seconds") ? number_of(body, "seconds", 1e-4, jobs::longest_play) : jobs::longest_play;
  const std::string state = free_name_of_file("run") + "-state.ply";
  const Tentative reached(project_->folder() / state, recorded_);
  request.new_state = reached.path();
  if (before.contains("state")) request.state = state_of(before, project_->folder());
  std::optional<Pace> pace;
  if (body.contains("speed")) pace.emplace(number_of(body, "speed", 0.01, 100), before.value("time", 0.0));
  request.watch = [&](double time, const std::vector<float>& positions) {
    show_moving(time, positions);
    if (pace) pace->wait_for(time, cancelled_);
  };
  request.watch_body = [this](const std::vector<float>& positions) { show_moving_body(positions); };
  Json pulls = Json::array();
  std::optional<RecordedHand> again;
  if (body.contains("pulls")) again = recorded_hand(body);
  request.hand = [&, last = std::optional<jobs::Grip>()](double time) mutable {
    const std::optional<jobs::Grip> grip = again ? again->at(time) : present_grip();
    if (grip != last) pulls.push_back(row_of_pull(time, grip));
    return last = grip;
  };
  struct Playing {
    explicit Playing(Session& of) : session(of) { session.begin_play(true); }
    ~Playing() { session.begin_play(false); }
    Session& session;
  } playing(*this);
  const jobs::PlayedSketch played = jobs::play_sketch(sketch_, strokes_on(drawing), request, *this);
  cancelled_ = false;  // it was paused: what was reached is kept
  did_ = {{"do", "play"}, {"seconds", played.time - before.value("time", 0.0)}};
  if (!pulls.empty()) did_["pulls"] = pulls;
  take_result("run", "move to " + seconds_text(played.time), played.file,
              motion_after(drawing, state, played.time, !pulls.empty()));
  return {{"time", played.time}, {"remarks", played.remarks}};
}

void Session::begin_play(bool on) {
  const std::lock_guard lock(grip_mutex_);
  playing_ = on;
  grip_.reset();
}

std::optional<jobs::Grip> Session::present_grip() {
  const std::lock_guard lock(grip_mutex_);
  return grip_;
}

void Session::pull(Client client, const Message& message) {
  try {
    const std::optional<jobs::Grip> grip = grip_of(message.body);
    const std::lock_guard lock(grip_mutex_);
    if (!playing_) throw Refused("the cloth does not move; press Play, and pull then");
    if (pen_ != client) throw Refused("another page is drawing");  // a page that has just come has no pen yet
    grip_ = grip;
  } catch (const Refused& e) {
    return out_.tell(client, {{"id", message.id}, {"refused", e.what()}});
  }
  out_.tell(client, {{"id", message.id}, {"done", Json::object()}});
}

Json Session::fit(const Json& body) {
  require_brought("fit");
  const std::string by = text_of(body, "by");
  if (by != "strain" && by != "distance") throw Refused("by: is neither strain nor distance");
  const auto colour = by == "strain" ? jobs::FitColour::strain : jobs::FitColour::distance;
  const jobs::SketchFit found = jobs::fit_sketch(sketch_, strokes_on(project_->now().drawing), colour, *this);
  out_.show(everybody, std::make_shared<const std::string>(colour_bytes(found.colours)));
  return {{"words", found.words}, {"legend", found.legend}};
}

Json Session::weigh(const Json&) {
  const jobs::SketchMass found = jobs::mass_of_sketch(sketch_, strokes_on(project_->now().drawing), *this);
  out_.show(everybody, std::make_shared<const std::string>(colour_bytes(found.colours)));
  return {{"words", found.words}, {"legend", found.legend}};
}

Json Session::find_tangles(const Json&) {
  const jobs::SketchTangles found = jobs::find_tangles(sketch_, strokes_on(project_->now().drawing), *this);
  if (found.pairs > 0) out_.show(everybody, std::make_shared<const std::string>(colour_bytes(found.colours)));
  Json answer{{"words", found.words}, {"pairs", found.pairs}};
  if (found.worst) answer["at"] = *found.worst;
  return answer;
}

void Session::show_moving(double time, const std::vector<float>& positions) {
  const auto now = std::chrono::steady_clock::now();
  if (now - moving_shown_ < std::chrono::milliseconds(15)) return;  // no display shows more
  moving_shown_ = now;
  out_.show(everybody, std::make_shared<const std::string>(moving_bytes(time, positions)));
}

void Session::show_moving_body(const std::vector<float>& positions) {
  const auto now = std::chrono::steady_clock::now();
  if (now - body_shown_ < std::chrono::milliseconds(30)) return;
  body_shown_ = now;
  body_moved_ = true;
  out_.show(everybody, std::make_shared<const std::string>(moving_bytes(0, positions, ShownAs::moving_body)));
}

}  // namespace furrow::studio
