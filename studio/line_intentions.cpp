// SPDX-License-Identifier: GPL-3.0-or-later
// What a page asks of lines.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "jobs/sketch/sketch_lines.h"
#include "studio/drawing.h"
#include "studio/session.h"

namespace furrow::studio {
namespace {

struct Range {
  double least, most;
  const char* words;
};
const std::map<std::string, Range>& number_keys() {
  static const std::map<std::string, Range> keys{{"height", {-1, 1, "the height"}},
                                                 {"width", {0.001, 10, "the width"}},
                                                 {"sharpness", {0, 1, "the sharpness"}},
                                                 {"press", {1, 1e6, "the press"}},
                                                 {"gather", {0.1, 1, "the gathers"}}};
  return keys;
}

bool flag_of(const Json& body, const char* key) {
  if (!body.contains(key)) return false;
  if (!body[key].is_boolean()) throw Refused(std::string(key) + ": is neither true nor false");
  return body[key] == true;
}

/// Changes what the message names of a line; returns what the step does to it.
std::string change_line(const Json& body, Json& line) {
  std::string what;
  for (const auto& [key, range] : number_keys()) {
    if (!body.contains(key)) continue;
    what = "change " + std::string(range.words) + " of";
    if ((key == "width" || key == "gather") && body[key].is_null())
      line["stroke"].erase(key);
    else
      line["stroke"][key] = number_of(body, key.c_str(), range.least, range.most);
  }
  if (body.contains("gather")) what = body["gather"].is_null() ? "let go the thread of" : "gather";
  if (body.contains("points")) {
    if (!line["stroke"].contains("points"))
      throw Refused("this line is given by vertices of the garment, not by points: draw it anew");
    what = "drag";
    line["stroke"]["points"] = points_of(body);
  }
  if (body.contains("on")) {
    const bool on = flag_of(body, "on");
    what = on ? "switch on" : "switch off";
    line["on"] = on;
  }
  if (body.contains("name")) {
    what = "rename";
    line["stroke"]["name"] = text_of(body, "name");
  }
  if (what.empty()) throw Refused("set: there is nothing to set");
  return what;
}

/// The lines that a message means: one, or several at once, which keep their names, places and signs.
std::vector<std::size_t> lines_of(const Json& body, std::size_t count) {
  if (!body.contains("lines")) return {index_of(body, "line", count)};
  const Json& list = body["lines"];
  if (!list.is_array() || list.empty() || list.size() > count) throw Refused("lines: is no list of lines");
  if (body.contains("name") || body.contains("points"))
    throw Refused("set: several lines at once keep their names and points");
  std::vector<std::size_t> lines;
  for (const Json& at : list) lines.push_back(index_of({{"line", at}}, "line", count));
  return lines;
}

/// As one of several: a ridge stays one, and a valley, too.
Json with_own_sign(Json body, const Json& line) {
  const Json own = line.at("stroke").value("height", Json());
  if (body.contains("height") && body["height"].is_number() && own.is_number())
    body["height"] = std::copysign(body["height"].get<double>(), own.get<double>());
  return body;
}

/// Whether a line is called as the studio calls a new one of that kind: "ridge 3".
bool has_name_of(const std::string& kind, const Json& stroke) {
  const std::string name = stroke.value("name", "");
  return name.rfind(kind + " ", 0) == 0 && name.size() > kind.size() + 1 &&
         name.find_first_not_of("0123456789", kind.size() + 1) == name.npos;
}

/// A ridge that has become a valley or gathers, or the other way round, goes on under a name of that kind,
/// unless somebody named it.
void rename_turned(const Json& drawing, const Json& before, Json& stroke) {
  const auto height = [](const Json& of) {
    return of.value("height", Json()).is_number() ? of["height"].get<double>() : 0.0;
  };
  const bool turned =
      before.contains("gather") != stroke.contains("gather") || height(before) * height(stroke) < 0;
  const std::string was = word_of(before);
  if (turned && was != word_of(stroke) && has_name_of(was, before) && stroke["name"] == before["name"])
    stroke["name"] = free_name_for(drawing, stroke);
}

/// The height at each point of a line, on the side of the line's own height.
Json heights_of(const Json& body, std::size_t points, double side) {
  const Json& heights = body["heights"];
  const auto fits = [&](const Json& h) {
    return h.is_number() && std::abs(h.get<double>()) <= 1 && h.get<double>() * side >= 0;
  };
  if (!heights.is_array() || heights.size() != points || !std::ranges::all_of(heights, fits))
    throw Refused("heights: is no list of a number for each point, all to the side of the height");
  return heights;
}

void add_line(Json& drawing, Json stroke) {
  drawing["lines"].push_back({{"on", true}, {"stroke", std::move(stroke)}});
}

}  // namespace

Json& Session::line_of(Json& drawing, const Json& body) const {
  Json& lines = drawing.at("lines");
  return lines[index_of(body, "line", lines.size())];
}

Json Session::draw(const Json& body) {
  Json drawing = project_->now().drawing;
  const double height = number_of(body, "height", -1, 1);
  Json stroke{{"name", body.contains("name") ? text_of(body, "name")
                                             : free_name(drawing, height < 0 ? "valley" : "ridge")},
              {"height", height}};
  if (body.contains("width")) stroke["width"] = number_of(body, "width", 0.001, 10);
  if (body.contains("sharpness")) stroke["sharpness"] = number_of(body, "sharpness", 0, 1);
  if (flag_of(body, "closed")) stroke["closed"] = true;
  stroke["points"] = points_of(body);
  if (body.contains("heights")) stroke["height"] = heights_of(body, stroke["points"].size(), height);
  const std::string name = stroke["name"];
  const bool both = flag_of(body, "mirror") && !jobs::lies_in_middle(stroke, middle());
  add_line(drawing, stroke);
  if (both) {
    Json other = jobs::mirrored(stroke, middle());
    other["name"] = free_name_for(drawing, other);
    add_line(drawing, std::move(other));
  }
  change((both ? "draw and mirror " : "draw ") + name, std::move(drawing));
  return Json::object();
}

Json Session::set(const Json& body) {
  Json drawing = project_->now().drawing;
  const std::vector<std::size_t> lines = lines_of(body, drawing.at("lines").size());
  std::string what;
  for (const std::size_t at : lines) {
    Json& line = drawing["lines"][at];
    if (lines.size() > 1 && body.contains("height") && line.at("stroke").contains("gather"))
      continue;  // has none
    const Json before = line.at("stroke");
    const std::string name = name_of_line(line);
    what = change_line(lines.size() > 1 ? with_own_sign(body, line) : body, line) + " " +
           (lines.size() > 1 ? std::to_string(lines.size()) + " lines" : name);
    rename_turned(drawing, before, line["stroke"]);
  }
  if (what.empty()) throw Refused("set: what a thread gathers has no height");
  if (flag_of(body, "live")) {
    show_preview(drawing);
    return {{"live", true}};
  }
  change(what, std::move(drawing));
  return Json::object();
}

Json Session::remove(const Json& body) {
  Json drawing = project_->now().drawing;
  const std::string name = name_of_line(line_of(drawing, body));
  drawing["lines"].erase(index_of(body, "line", drawing["lines"].size()));
  change("delete " + name, std::move(drawing));
  return Json::object();
}

Json Session::duplicate(const Json& body) {
  Json drawing = project_->now().drawing;
  const Json& line = line_of(drawing, body);
  const std::string from = name_of_line(line);
  Json stroke = jobs::beside(sketch_, line.at("stroke"));
  stroke["name"] = free_name_for(drawing, stroke);
  add_line(drawing, std::move(stroke));
  change("duplicate " + from, std::move(drawing));
  return Json::object();
}

Json Session::mirror(const Json& body) {
  Json drawing = project_->now().drawing;
  const Json& line = line_of(drawing, body);
  const std::string from = name_of_line(line);
  if (jobs::lies_in_middle(line.at("stroke"), middle()))
    throw Refused("this line lies in the middle already, and would be drawn over itself");
  Json stroke = jobs::mirrored(line.at("stroke"), middle());
  stroke["name"] = free_name_for(drawing, stroke);
  add_line(drawing, std::move(stroke));
  change("mirror " + from, std::move(drawing));
  return Json::object();
}

Json Session::move(const Json& body) {
  Json drawing = project_->now().drawing;
  Json& lines = drawing["lines"];
  const std::size_t from = index_of(body, "line", lines.size()), to = index_of(body, "to", lines.size());
  if (from == to) throw Refused("the line is there already");
  Json line = lines[from];
  const std::string name = name_of_line(line);
  lines.erase(from);
  lines.insert(lines.begin() + std::ptrdiff_t(to), std::move(line));
  change("move " + name + (to < from ? " up" : " down"), std::move(drawing));
  return Json::object();
}

Json Session::set_middle(const Json& body) {
  Json drawing = project_->now().drawing;
  drawing["middle"] = number_of(body, "x", -1000, 1000);
  change("move the middle", std::move(drawing));
  return Json::object();
}

Json Session::tell_points(const Json& body) {
  Json drawing = project_->now().drawing;
  const Json& stroke = line_of(drawing, body).at("stroke");
  return {{"points", stroke.value("points", Json::array())}};
}

}  // namespace furrow::studio
