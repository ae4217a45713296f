// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/session.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <new>
#include <utility>

#include "jobs/fit_sketch.h"
#include "studio/frame_bytes.h"

namespace furrow::studio {
namespace {

jobs::SceneInput scene_of_drawing(const Json& drawing, const std::filesystem::path& folder) {
  return {io::document_of(drawing.at("settings"), "the project"), folder};
}

Json drawing_of(const Json& settings, const Json& strokes) {
  Json lines = Json::array();
  for (const Json& stroke : strokes) lines.push_back({{"on", true}, {"stroke", stroke}});
  return {{"settings", settings}, {"lines", lines}, {"earlier", Json::array()}};
}

/// The strokes of those lines that are on.
Json strokes_on(const Json& drawing) {
  Json strokes = Json::array();
  for (const Json& line : drawing.at("lines"))
    if (line.value("on", true)) strokes.push_back(line.at("stroke"));
  return strokes;
}

std::string name_of_line(const Json& line) { return line.at("stroke").value("name", "a line"); }

bool holds_top(const Json& settings) {
  return settings.value("pins", Json::array()) == Json::array({Json{{"loop", "top"}}});
}

/// What the list shows of a line.
Json row_of(const Json& line) {
  const Json& stroke = line.at("stroke");
  Json row{{"name", name_of_line(line)}, {"on", line.value("on", true)}};
  for (const char* key : {"height", "width", "sharpness", "press", "closed"})
    if (stroke.contains(key) && !stroke[key].is_array()) row[key] = stroke[key];
  row["varies"] = stroke.contains("height") && stroke["height"].is_array();
  return row;
}

struct Range {
  double least, most;
  const char* words;
};
const std::map<std::string, Range>& number_keys() {
  static const std::map<std::string, Range> keys{{"height", {-1, 1, "the height"}},
                                                 {"width", {0.001, 10, "the width"}},
                                                 {"sharpness", {0, 1, "the sharpness"}},
                                                 {"press", {1, 1e6, "the press"}}};
  return keys;
}

/// The mesh of a file in the project's folder takes the garment's place, and the lines that are on are in it.
void take_as_garment(const std::string& file, Json& drawing) {
  drawing["settings"]["garment"] = {{"mesh", file}};
  const Json lines = std::exchange(drawing["lines"], Json::array());
  for (const Json& line : lines) {
    if (line.value("on", true))
      drawing["earlier"].push_back(name_of_line(line));
    else
      drawing["lines"].push_back(line);
  }
}

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f s", seconds);
  return text;
}

}  // namespace

Session::Session(const jobs::SceneInput& scene, const std::filesystem::path& folder, Outbox& out)
    : out_(out) {
  const jobs::Sketch opened = jobs::open_sketch(scene, *this);
  const Json settings = jobs::settings_for(opened, folder);
  const Json drawing = drawing_of(settings, jobs::strokes_of(opened, *this));
  project_.emplace(folder, settings, Step{"the beginning", drawing});
  take_up(project_->now().drawing);
  show_now();
}

Session::Session(const std::filesystem::path& folder, Outbox& out) : out_(out) {
  project_.emplace(folder);
  take_up(project_->now().drawing);
  show_now();
}

void Session::progress(const std::string& what, double share) {
  if (playing_) return;
  const auto now = std::chrono::steady_clock::now();
  if (share < 1 && now - progress_told_ < std::chrono::milliseconds(100)) return;
  progress_told_ = now;
  out_.tell(everybody, {{"progress", {{"what", what}, {"share", share}}}});
}

void Session::take_up(const Json& drawing) {
  sketch_ = jobs::open_sketch(scene_of_drawing(drawing, project_->folder()), *this);
  body_ = nullptr;
  if (sketch_.body)
    body_ =
        std::make_shared<const std::string>(frame_bytes(ShownAs::body, jobs::shown_mesh(sketch_.body->mesh)));
}

void Session::show_now() {
  std::optional<std::string> bytes = project_->frame();
  if (!bytes) {
    const auto drawn = jobs::draw_sketch(sketch_, strokes_on(project_->now().drawing), *this);
    bytes = frame_bytes(ShownAs::cloth, drawn.shown);
    project_->keep_frame(*bytes);
  }
  cloth_ = std::make_shared<const std::string>(std::move(*bytes));
  out_.tell(everybody, {{"status", status()}});
  if (body_) out_.show(everybody, body_);
  out_.show(everybody, cloth_);
}

void Session::greet(Client client) {
  if (pen_ == everybody) pen_ = client;
  out_.tell(client, {{"you", client}});
  out_.tell(client, {{"status", status()}});
  if (body_) out_.show(client, body_);
  out_.show(client, cloth_);
}

void Session::leave(Client client) {
  if (pen_ != client) return;
  pen_ = everybody;
  out_.tell(everybody, {{"status", status()}});
}

Json Session::status() const {
  const Json& drawing = project_->now().drawing;
  const Json& settings = drawing.at("settings");
  Json rows = Json::array(), shown = Json::array();
  for (std::size_t i = 0; i < drawing.at("lines").size(); ++i) {
    rows.push_back(row_of(drawing["lines"][i]));
    if (rows.back()["on"] == true) shown.push_back(i);
  }
  return {{"title", project_->folder().filename().string()},
          {"lines", rows},
          {"shown", shown},
          {"earlier", drawing.value("earlier", Json::array())},
          {"fabric", settings.value("material", Json::object()).value("preset", "")},
          {"fabrics", jobs::fabric_names()},
          {"holds_top", holds_top(settings)},
          {"pins", settings.value("pins", Json::array()).size()},
          {"has_body", body_ != nullptr},
          {"time", drawing.value("motion", Json::object()).value("time", 0.0)},
          {"can_drape", body_ != nullptr || !sketch_.pins.empty()},
          {"undo", project_->next_undo()},
          {"redo", project_->next_redo()},
          {"step", project_->at()},
          {"pen", pen_}};
}

void Session::handle(Client client, const Message& message) {
  told_.clear();
  std::string why;
  try {
    if (pen_ == everybody || message.what == "take") pen_ = client;
    if (pen_ != client)
      throw Refused("another page is drawing; press \"Take the pen\" here to draw on this one");
    Json answer = done(message);
    if (!told_.empty()) answer["told"] = told_;
    return out_.tell(client, {{"id", message.id}, {"done", answer}});
  } catch (const std::bad_alloc&) {
    why = "not enough memory for that; nothing was changed";
  } catch (const std::exception& e) {
    why = cancelled_ ? "stopped; nothing was changed" : e.what();
  }
  out_.tell(client, {{"id", message.id}, {"refused", why}});
}

Json Session::done(const Message& message) {
  const std::string& what = message.what;
  const Json& body = message.body;
  Json answer = Json::object();
  if (what == "draw")
    draw(body);
  else if (what == "set")
    answer = set(body);
  else if (what == "delete")
    remove(body);
  else if (what == "mirror")
    mirror(body);
  else if (what == "fabric")
    choose_fabric(body);
  else if (what == "hold")
    hold(body);
  else if (what == "drape")
    answer = drape();
  else if (what == "play")
    answer = play(body);
  else if (what == "fit")
    answer = fit(body);
  else if (what == "undo" || what == "redo")
    undo(what == "redo");
  else if (what == "save")
    answer["written"] =
        jobs::save_sketch(sketch_, strokes_on(project_->now().drawing), project_->folder(), *this);
  else if (what == "show" || what == "take")
    show_now();
  else
    throw Refused("there is nothing called '" + what + "' to do");
  if (!body.contains("live") && what != "show" && what != "take" && what != "fit") {
    Json line = body;
    line.erase("id");
    project_->log(line);
  }
  return answer;
}

void Session::change(const std::string& what, Json drawing) {
  std::optional<jobs::Sketch> other;
  if (drawing.at("settings") != project_->now().drawing.at("settings"))
    other = jobs::open_sketch(scene_of_drawing(drawing, project_->folder()), *this);
  const auto drawn = jobs::draw_sketch(other ? *other : sketch_, strokes_on(drawing), *this);
  told_.insert(told_.end(), drawn.told.begin(), drawn.told.end());
  const std::string bytes = frame_bytes(ShownAs::cloth, drawn.shown);
  project_->add({what, std::move(drawing)});
  project_->keep_frame(bytes);
  if (other) sketch_ = std::move(*other);
  cloth_ = std::make_shared<const std::string>(bytes);
  out_.tell(everybody, {{"status", status()}});
  out_.show(everybody, cloth_);
}

std::string Session::free_name(const std::string& word) const {
  const Json& drawing = project_->now().drawing;
  for (int n = 1;; ++n) {
    const std::string name = word + " " + std::to_string(n);
    const auto is_it = [&](const Json& line) { return name_of_line(line) == name; };
    const Json& lines = drawing.at("lines");
    const Json earlier = drawing.value("earlier", Json::array());
    if (std::none_of(lines.begin(), lines.end(), is_it) &&
        std::find(earlier.begin(), earlier.end(), Json(name)) == earlier.end())
      return name;
  }
}

std::string Session::free_name_of_file(const std::string& word) const {
  for (int n = 1;; ++n) {
    std::string name = word + "-" + std::to_string(n);
    if (!std::filesystem::exists(project_->folder() / (name + ".ply"))) return name;
  }
}

void Session::draw(const Json& body) {
  const double height = number_of(body, "height", -1, 1);
  Json stroke{
      {"name", body.contains("name") ? text_of(body, "name") : free_name(height < 0 ? "valley" : "ridge")},
      {"height", height}};
  if (body.contains("width")) stroke["width"] = number_of(body, "width", 0.001, 10);
  if (body.value("closed", Json(false)) == true) stroke["closed"] = true;
  stroke["points"] = points_of(body);
  Json drawing = project_->now().drawing;
  const std::string name = stroke["name"];
  drawing["lines"].push_back({{"on", true}, {"stroke", std::move(stroke)}});
  change("draw " + name, std::move(drawing));
}

Json& Session::line_of(Json& drawing, const Json& body) const {
  Json& lines = drawing.at("lines");
  return lines[index_of(body, "line", lines.size())];
}

Json Session::set(const Json& body) {
  Json drawing = project_->now().drawing;
  Json& line = line_of(drawing, body);
  std::string what = "change " + name_of_line(line);
  bool found = false;
  for (const auto& [key, range] : number_keys()) {
    if (!body.contains(key)) continue;
    found = true;
    what = "change " + std::string(range.words) + " of " + name_of_line(line);
    if (key == "width" && body[key].is_null())
      line["stroke"].erase(key);
    else
      line["stroke"][key] = number_of(body, key.c_str(), range.least, range.most);
  }
  if (body.contains("on")) {
    if (!body["on"].is_boolean()) throw Refused("on: is neither true nor false");
    what = (body["on"] == true ? "switch on " : "switch off ") + name_of_line(line);
    line["on"] = body["on"];
  }
  if (body.contains("name")) {
    what = "rename " + name_of_line(line);
    line["stroke"]["name"] = text_of(body, "name");
  }
  if (!found && !body.contains("on") && !body.contains("name")) throw Refused("set: there is nothing to set");
  if (body.value("live", Json(false)) != true) {
    change(what, std::move(drawing));
    return Json::object();
  }
  const auto drawn = jobs::draw_sketch(sketch_, strokes_on(drawing), *this);
  out_.show(everybody, std::make_shared<const std::string>(frame_bytes(ShownAs::preview, drawn.shown)));
  return {{"live", true}};
}

void Session::remove(const Json& body) {
  Json drawing = project_->now().drawing;
  const std::string name = name_of_line(line_of(drawing, body));
  drawing["lines"].erase(index_of(body, "line", drawing["lines"].size()));
  change("delete " + name, std::move(drawing));
}

void Session::mirror(const Json& body) {
  Json drawing = project_->now().drawing;
  const Json& line = line_of(drawing, body);
  const std::string from = name_of_line(line);
  Json stroke = jobs::mirrored(sketch_, line.at("stroke"));
  const Json height = stroke.value("height", Json());
  stroke["name"] = free_name(height.is_number() && height.get<double>() < 0 ? "valley" : "ridge");
  drawing["lines"].push_back({{"on", true}, {"stroke", std::move(stroke)}});
  change("mirror " + from, std::move(drawing));
}

void Session::choose_fabric(const Json& body) {
  Json drawing = project_->now().drawing;
  const std::string name = text_of(body, "name");
  drawing["settings"]["material"]["preset"] = name;
  change("choose " + name, std::move(drawing));
}

void Session::hold(const Json& body) {
  const Json on = body.value("on", Json());
  if (!on.is_boolean()) throw Refused("on: is neither true nor false");
  Json drawing = project_->now().drawing;
  Json& settings = drawing["settings"];
  if (settings.value("pins", Json::array()).size() > 0 && !holds_top(settings))
    throw Refused("the scene has pins of its own, which stay as they are");
  settings["pins"] = Json::array();
  if (on == true) settings["pins"].push_back({{"loop", "top"}});
  drawing.erase("motion");  // whose pins are others
  change(on == true ? "hold the upper border" : "let the upper border go", std::move(drawing));
}

Json Session::drape() {
  Json drawing = project_->now().drawing;
  const jobs::SketchAtRest rest = jobs::drape_sketch(sketch_, strokes_on(drawing), *this);
  const std::string file = free_name_of_file("rest") + ".ply";
  jobs::write_sketched(sketch_, rest.file, project_->folder() / file, *this);
  take_as_garment(file, drawing);
  drawing.erase("motion");
  change("drape", std::move(drawing));
  return {{"outcome", rest.outcome}, {"remarks", rest.remarks}};
}

Json Session::play(const Json& body) {
  Json drawing = project_->now().drawing;
  jobs::PlayRequest request;
  request.seconds =
      body.contains("seconds") ? number_of(body, "seconds", 1e-4, jobs::longest_play) : jobs::longest_play;
  const std::string name = free_name_of_file("run"), file = name + ".ply", state = name + "-state.ply";
  request.new_state = project_->folder() / state;
  const Json before = drawing.value("motion", Json::object());
  if (before.contains("state")) request.state = project_->folder() / before["state"].get<std::string>();
  request.watch = [this](double time, const std::vector<float>& positions) { show_moving(time, positions); };
  struct Playing {
    explicit Playing(bool& is_on) : is_on_(is_on) { is_on_ = true; }
    ~Playing() { is_on_ = false; }
    bool& is_on_;
  } playing(playing_);
  const jobs::PlayedSketch played = jobs::play_sketch(sketch_, strokes_on(drawing), request, *this);
  cancelled_ = false;  // it was paused: what was reached is kept
  jobs::write_sketched(sketch_, played.file, project_->folder() / file, *this);
  take_as_garment(file, drawing);
  drawing["motion"] = {{"state", state}, {"time", played.time}};
  change("move to " + seconds_text(played.time), std::move(drawing));
  return {{"time", played.time}, {"remarks", played.remarks}};
}

Json Session::fit(const Json& body) {
  const std::string by = text_of(body, "by");
  if (by != "strain" && by != "distance") throw Refused("by: is neither strain nor distance");
  const auto colour = by == "strain" ? jobs::FitColour::strain : jobs::FitColour::distance;
  const jobs::SketchFit found = jobs::fit_sketch(sketch_, strokes_on(project_->now().drawing), colour, *this);
  out_.show(everybody, std::make_shared<const std::string>(colour_bytes(found.colours)));
  return {{"words", found.words}, {"legend", found.legend}};
}

void Session::show_moving(double time, const std::vector<float>& positions) {
  const auto now = std::chrono::steady_clock::now();
  if (now - moving_shown_ < std::chrono::milliseconds(15)) return;  // no display shows more
  moving_shown_ = now;
  out_.show(everybody, std::make_shared<const std::string>(moving_bytes(time, positions)));
}

void Session::undo(bool again) {
  if ((again ? project_->next_redo() : project_->next_undo()).empty())
    throw Refused(again ? "there is nothing to do again" : "there is nothing to undo");
  const Json before = project_->now().drawing.at("settings");
  again ? project_->redo() : project_->undo();
  if (project_->now().drawing.at("settings") != before) take_up(project_->now().drawing);
  show_now();
}

}  // namespace furrow::studio
