// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/session.h"

#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include "jobs/move/give_motion.h"
#include "jobs/sketch/give_sketch.h"
#include "jobs/sketch/sketch_lines.h"
#include "jobs/sketch/sketch_pins.h"
#include "studio/drawing.h"
#include "studio/frame_bytes.h"

namespace furrow::studio {
namespace {

Bytes shared(std::string bytes) { return std::make_shared<const std::string>(std::move(bytes)); }

Json rows_of_borders(const jobs::Sketch& sketch) {
  Json rows = Json::array();
  for (const jobs::SketchBorder& border : jobs::borders_of(sketch))
    rows.push_back({{"name", border.name}, {"length", border.length}, {"held", border.held}});
  return rows;
}

Json rows_of_parts(const std::vector<jobs::SketchPart>& parts) {
  Json rows = Json::array();
  for (const jobs::SketchPart& part : parts) rows.push_back({{"name", part.name}, {"goes", part.goes}});
  return rows;
}

Json rows_of_fabrics() {
  Json rows = Json::array();
  for (const jobs::FabricChoice& fabric : jobs::fabric_choices())
    rows.push_back({{"name", fabric.name}, {"words", fabric.words}});
  return rows;
}

}  // namespace

const std::map<std::string, Session::Does>& Session::intentions() {
  static const std::map<std::string, Does> all{{"draw", &Session::draw},
                                               {"set", &Session::set},
                                               {"delete", &Session::remove},
                                               {"duplicate", &Session::duplicate},
                                               {"mirror", &Session::mirror},
                                               {"move", &Session::move},
                                               {"middle", &Session::set_middle},
                                               {"fabric", &Session::choose_fabric},
                                               {"wind", &Session::blow},
                                               {"hold", &Session::hold},
                                               {"pin", &Session::pin},
                                               {"attach", &Session::attach},
                                               {"drape", &Session::drape},
                                               {"touch", &Session::touch},
                                               {"keep", &Session::keep},
                                               {"play", &Session::play},
                                               {"undo", &Session::undo},
                                               {"redo", &Session::redo},
                                               {"points", &Session::tell_points},
                                               {"history", &Session::tell_history},
                                               {"fit", &Session::fit},
                                               {"weigh", &Session::weigh},
                                               {"tangles", &Session::find_tangles},
                                               {"save", &Session::save},
                                               {"give", &Session::give},
                                               {"show", &Session::show},
                                               {"take", &Session::show}};
  return all;
}

Session::Session(const jobs::SceneInput& scene, const std::filesystem::path& folder, Outbox& out,
                 const std::filesystem::path& made_for)
    : out_(out) {
  const jobs::Sketch opened = jobs::open_sketch(scene, *this, made_for);
  jobs::check_made_for(opened, *this);
  const Json settings = jobs::settings_for(opened, folder);
  Json drawing = drawing_of(settings, jobs::strokes_of(opened, *this)), opened_with = settings;
  note_made_for(made_for, folder, drawing);
  if (drawing.contains("made_for")) opened_with["made_for"] = drawing["made_for"];
  project_.emplace(folder, opened_with, Step{"the beginning", drawing});
  open_present();
}

Session::Session(const std::filesystem::path& folder, Outbox& out) : out_(out) {
  project_.emplace(folder);
  open_present();
}

void Session::progress(const std::string& what, double share) {
  if (playing_) return;
  const auto now = std::chrono::steady_clock::now();
  if (share < 1 && now - progress_told_ < std::chrono::milliseconds(100)) return;
  progress_told_ = now;
  out_.tell(everybody, {{"progress", {{"what", what}, {"share", share}}}});
}

struct Session::Prepared {
  std::optional<jobs::Sketch> sketch;  ///< none: the present one stays
  double middle = 0;
  std::vector<jobs::SketchPart> parts;
  Bytes body, cloth;
};

Session::Prepared Session::prepare(const Json& drawing, std::optional<std::string> frame) {
  Prepared made;
  if (!cloth_ || drawing.at("settings") != project_->now().drawing.at("settings")) {
    made.sketch = open_drawing(drawing, project_->folder(), *this);
    made.sketch->scene.memory.shelf = shelf_;
    made.middle = jobs::middle_of(*made.sketch);
    made.parts = jobs::loose_parts_of(*made.sketch);
    if (made.sketch->body)
      made.body = shared(frame_bytes(ShownAs::body, jobs::shown_mesh(made.sketch->body->mesh)));
    if (made.body && body_ && *body_ == *made.body) made.body = body_;
  }
  if (!frame || !is_frame(*frame)) {
    const jobs::Sketch& sketch = made.sketch ? *made.sketch : sketch_;
    const auto drawn = jobs::draw_sketch(sketch, strokes_on(drawing), *this);
    told_.insert(told_.end(), drawn.told.begin(), drawn.told.end());
    frame = frame_bytes(ShownAs::cloth, drawn.shown);
  }
  made.cloth = shared(std::move(*frame));
  return made;
}

void Session::take(Prepared made) noexcept {
  if (made.sketch) {
    sketch_ = std::move(*made.sketch);
    middle_of_sketch_ = made.middle;
    parts_of_sketch_ = std::move(made.parts);
    body_ = std::move(made.body);
  }
  cloth_ = std::move(made.cloth);
}

void Session::open_present() {
  std::optional<std::string> kept = project_->frame(project_->at());
  const bool is_kept = kept && is_frame(*kept);
  take(prepare(project_->now().drawing, std::move(kept)));
  if (!is_kept) project_->keep_frame(*cloth_);
  show_all();
}

void Session::note_unkept(const std::string& why) {
  if (!why.empty())
    told_.push_back("the step is recorded, but its picture is not, and is drawn anew when it is needed: " +
                    why);
}

void Session::show_all() {
  out_.tell(everybody, {{"status", status()}});
  show_body();
  out_.show(everybody, cloth_);
}

/// Where it is another one, or stands elsewhere than the pages show it.
void Session::show_body() {
  const Bytes moved = moved_body();
  if (body_ && (body_ != shown_body_ || (body_moved_ && !moved))) out_.show(everybody, body_);
  if (moved) out_.show(everybody, moved);
  shown_body_ = body_;
  body_moved_ = moved != nullptr;
}

/// Where a body that has moved stands now; null: as it began.
Bytes Session::moved_body() {
  const double time = project_->now().drawing.value("motion", Json::object()).value("time", 0.0);
  if (!body_ || time == 0) return nullptr;
  const std::vector<float> body = jobs::body_at(sketch_, time);
  return body.empty() ? nullptr : shared(moving_bytes(0, body, ShownAs::moving_body));
}

void Session::greet(Client client) {
  if (pen_ == everybody) pen_ = client;
  out_.tell(client, {{"you", client}});
  out_.tell(client, {{"status", status()}});
  if (body_) out_.show(client, body_);
  if (const Bytes moved = moved_body()) out_.show(client, moved);
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
  const Json wind = settings.value("forces", Json::object()).value("wind", Json::array({0.0, 0.0, 0.0}));
  return {{"title", project_->folder().filename().string()},
          {"lines", rows},
          {"shown", shown},
          {"earlier", drawing.value("earlier", Json::array())},
          {"fabric", settings.value("material", Json::object()).value("preset", "")},
          {"fabrics", rows_of_fabrics()},
          {"borders", rows_of_borders(sketch_)},
          {"parts", rows_of_parts(parts_of_sketch_)},
          {"wind", wind},
          {"middle", middle()},
          {"has_body", body_ != nullptr},
          {"made_for_another", drawing.contains("made_for")},
          {"time", drawing.value("motion", Json::object()).value("time", 0.0)},
          {"can_drape", body_ != nullptr || !sketch_.pins.empty()},
          {"undo", project_->next_undo()},
          {"redo", project_->next_redo()},
          {"step", project_->at()},
          {"pen", pen_.load()}};
}

double Session::middle() const {
  const Json& drawing = project_->now().drawing;
  return drawing.contains("middle") ? drawing["middle"].get<double>() : middle_of_sketch_;
}

void Session::handle(Client client, const Message& message) {
  told_.clear();
  lost_ = recorded_ = false;
  std::string why;
  Json answer = Json::object();
  try {
    if (pen_ == everybody || message.what == "take") pen_ = client;
    if (pen_ != client)
      throw Refused("another page is drawing; press \"Take the pen\" here to draw on this one");
    const jobs::OutputsBelow below(project_->folder());
    answer = done(message);
  } catch (const std::bad_alloc&) {
    why = "not enough memory for that; nothing was changed";
  } catch (const std::exception& e) {
    why = cancelled_ ? "stopped; nothing was changed" : e.what();
  }
  if (!why.empty() && !recorded_) return out_.tell(client, {{"id", message.id}, {"refused", why}});
  if (!why.empty())
    told_.push_back("the step is recorded, but not all that follows it was done; reload the page");
  if (!told_.empty()) answer["told"] = told_;
  out_.tell(client, {{"id", message.id}, {"done", answer}});
}

Json Session::done(const Message& message) {
  const auto found = intentions().find(message.what);
  if (found == intentions().end()) throw Refused("there is nothing called '" + message.what + "' to do");
  did_ = message.body;
  did_.erase("id");
  return (this->*found->second)(message.body);
}

void Session::change(const std::string& what, Json drawing) {
  Prepared made = prepare(drawing, std::nullopt);
  project_->add({what, std::move(drawing)}, did_);
  recorded_ = true;
  take(std::move(made));
  note_unkept(project_->keep_frame(*cloth_));
  show_all();
}

void Session::show_preview(const Json& drawing) {
  const auto drawn = jobs::draw_sketch(sketch_, strokes_on(drawing), *this);
  out_.show(everybody, shared(frame_bytes(ShownAs::preview, drawn.shown)));
}

std::string Session::shape_bits() {
  const Json strokes = strokes_on(project_->now().drawing);
  return jobs::shape_bits(jobs::draw_sketch(sketch_, strokes, *this).file);
}

std::string Session::free_name_of_file(const std::string& word) const {
  for (int n = 1;; ++n) {
    std::string name = word + "-" + std::to_string(n);
    std::error_code none;
    if (!std::filesystem::exists(std::filesystem::symlink_status(project_->folder() / (name + ".ply"), none)))
      return name;
  }
}

Json Session::undo(const Json&) {
  go(false);
  return Json::object();
}

Json Session::redo(const Json&) {
  go(true);
  return Json::object();
}

void Session::go(bool again) {
  if ((again ? project_->next_redo() : project_->next_undo()).empty())
    throw Refused(again ? "there is nothing to do again" : "there is nothing to undo");
  const Step to = again ? project_->after() : project_->before();
  std::optional<std::string> kept = project_->frame(again ? project_->at() + 1 : project_->at() - 1);
  const bool is_kept = kept && is_frame(*kept);
  Prepared made = prepare(to.drawing, std::move(kept));
  again ? project_->redo() : project_->undo();
  recorded_ = true;
  take(std::move(made));
  told_.clear();  // it was told when the step was made
  if (!is_kept) project_->keep_frame(*cloth_);
  show_all();
}

Json Session::save(const Json&) {
  const Json& drawing = project_->now().drawing;
  std::vector<std::string> written =
      jobs::save_sketch(sketch_, strokes_on(drawing), project_->folder(), *this);
  if (const auto motion = motion_of(drawing))
    for (const std::string& file : jobs::save_motion(*motion, sketch_.frame, project_->folder()))
      written.push_back(file);
  if (drawing.contains("made_for"))
    told_.push_back(
        "in scene.toml the garment lies about the body that it was made for; drape it, which brings it to "
        "its own, before you simulate it");
  return {{"written", written}};
}

Json Session::give(const Json& body) {
  const Step first = project_->first();
  const std::filesystem::path garment = first.drawing.at("settings").at("garment").value("mesh", "");
  const std::filesystem::path original = project_->folder() / garment;
  const std::string as = text_of(body, "as");
  if (as == "moving glb" || as == "pc2")
    return give_animation(jobs::title_of(original) + (as == "pc2" ? ".pc2" : "-moving.glb"));
  const std::filesystem::path path = jobs::give_sketch(sketch_, strokes_on(project_->now().drawing), as,
                                                       original, project_->folder() / "give", *this);
  return {{"file", std::filesystem::absolute(path).lexically_normal().string()}};
}

/// The motion since the last drape, or since the beginning, once more.
Json Session::give_animation(const std::string& name) {
  const Json& drawing = project_->now().drawing;
  const auto motion = motion_of(drawing);
  if (!motion)
    throw Refused(
        drawing.contains("motion")
            ? "this motion cannot be done again to the same bits, as it was pulled at, or fabric, wind or "
              "pins changed on the way; drape or undo, and play anew"
            : "nothing has moved yet; press Play first");
  jobs::save_motion(*motion, sketch_.frame, project_->folder());
  const std::filesystem::path file = project_->folder() / "give" / name;
  jobs::OutputsBelow::check(file.parent_path());
  std::filesystem::create_directories(file.parent_path());
  std::string files;
  for (const auto& part : jobs::give_motion(project_->folder() / "motion.toml", file, *this))
    files += (files.empty() ? "" : ", ") + std::filesystem::absolute(part).lexically_normal().string();
  return {{"file", files}};
}

/// The latest steps by name, and which of them the cloth is at.
Json Session::tell_history(const Json&) {
  constexpr std::size_t most = 50;
  const std::size_t first = project_->at() > most ? project_->at() - most : 0;
  return {{"first", first}, {"at", project_->at()}, {"steps", project_->names_from(first)}};
}

Json Session::show(const Json&) {
  show_all();
  return Json::object();
}

}  // namespace furrow::studio
