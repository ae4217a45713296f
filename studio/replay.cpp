// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/replay.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "studio/drawing.h"
#include "studio/session.h"

namespace furrow::studio {
namespace {

namespace fs = std::filesystem;

/// Hears the answer to what was asked last.
class Hearing : public Outbox {
 public:
  void tell(Client, const Json& message) override {
    if (message.contains("id")) answer = message;
  }
  void show(Client, Bytes) override {}
  Json answer;
};

class Nobody : public jobs::Listener {};

/// Begins the project anew in another folder, from which its files are named.
void begin_again(const Project& recorded, const fs::path& into) {
  Nobody nobody;
  Step first = recorded.first();
  const jobs::Sketch sketch = open_drawing(first.drawing, recorded.folder(), nobody);
  first.drawing["settings"] = jobs::settings_for(sketch, into);
  note_made_for(sketch.made_for, into, first.drawing);
  const Project begun(into, first.drawing["settings"], first);  // and let go, for the session
}

std::string shape_of(const Project& project) {
  Nobody nobody;
  const Json& drawing = project.now().drawing;
  const jobs::Sketch sketch = open_drawing(drawing, project.folder(), nobody);
  return jobs::shape_bits(jobs::draw_sketch(sketch, strokes_on(drawing), nobody).file);
}

std::string difference_of(const Project& recorded, Session& session) {
  const Project& again = session.project();
  if (again.at() != recorded.at() || again.count() != recorded.count())
    return "it ended at step " + std::to_string(again.at()) + " of " + std::to_string(again.count()) +
           ", the project is at step " + std::to_string(recorded.at()) + " of " +
           std::to_string(recorded.count());
  for (const char* key : {"lines", "earlier"})
    if (again.now().drawing.value(key, Json()) != recorded.now().drawing.value(key, Json()))
      return std::string("the ") + (key == std::string("lines") ? "lines" : "lines of earlier") + " differ";
  if (again.now().what != recorded.now().what)
    return "the last step is '" + again.now().what + "', and was '" + recorded.now().what + "'";
  return session.shape_bits() == shape_of(recorded) ? "" : "the shape differs";
}

}  // namespace

ReplayReport replay(const fs::path& folder, const fs::path& into,
                    const std::function<bool(std::size_t, std::size_t)>& go_on) {
  const Project recorded(folder, Project::Access::read);
  if (fs::exists(into) && !(fs::is_directory(into) && fs::is_empty(into)))
    throw std::invalid_argument(into.string() + ": is there already; move it away");
  const std::vector<Json> log = recorded.log();
  begin_again(recorded, into);
  Hearing hearing;
  Session session(into, hearing);
  ReplayReport report{log.size(), recorded.at(), "", false};
  constexpr Client page = 1;
  for (std::size_t i = 0; i < log.size(); ++i) {
    if (!go_on(i, log.size())) {
      report.cancelled = true;
      return report;
    }
    const std::string what = log[i].value("do", "");
    session.handle(page, {i, what, log[i]});
    if (hearing.answer.contains("done")) continue;
    report.difference = "intention " + std::to_string(i + 1) + " (" + what +
                        ") was refused: " + hearing.answer.value("refused", "");
    return report;
  }
  report.difference = difference_of(recorded, session);
  return report;
}

}  // namespace furrow::studio
