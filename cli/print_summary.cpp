// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/print_summary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "geometry/mesh/measures.h"
#include "io/base/shell_word.h"

namespace furrow::cli {
namespace {

using geometry::length_text;
using Lines = std::vector<std::string>;

constexpr std::size_t most_lines = 8;      // about a job; the rest is cut
constexpr double most_off_by_steps = 0.2;  // of all energy that is lost, without a hint

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

double value_of(const Json& report, const char* key) {
  const auto at = report.find(key);
  return at != report.end() && at->is_number() ? at->get<double>() : NAN;
}

std::string text_of(const Json& report, const char* key) {
  const auto at = report.find(key);
  return at != report.end() && at->is_string() ? at->get<std::string>() : "";
}

const Json& list_of(const Json& report, const char* key) {
  static const Json empty = Json::array();
  const auto at = report.find(key);
  return at != report.end() && at->is_array() ? *at : empty;
}

const Json& table_of(const Json& report, const char* key) {
  static const Json empty = Json::object();
  const auto at = report.find(key);
  return at != report.end() && at->is_object() ? *at : empty;
}

long long count_of(const Json& report, const char* key) {
  const double value = value_of(report, key);
  return std::isfinite(value) ? static_cast<long long>(value) : 0;
}

std::string length_or_unknown(double value) { return std::isfinite(value) ? length_text(value) : "unknown"; }

std::string length(const Json& report, const char* key) { return length_or_unknown(value_of(report, key)); }

/// What is below a thousandth of a per cent is none.
std::string per_cent(double share) {
  if (!std::isfinite(share)) return "unknown";
  return number(std::abs(share) < 1e-5 ? 0 : 100 * share) + " %";
}

/// Whether a rest state holds still: its second derivatives tell nothing where forces do not balance.
std::string balance_of(const Json& rest, const std::string& good, const std::string& shape) {
  constexpr double out_of_balance = 1e-6;  // of the weight
  if (!(value_of(rest, "residual") <= out_of_balance)) return "look at: " + shape + " is not in balance";
  if (!rest.value("stable", false)) return "look at: " + shape + " is balanced, but not stable";
  return good + shape + " is at rest, and stable";
}

/// "1 face", "3 faces".
std::string counted(long long n, const std::string& what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

/// What the garment's crossings are, if there are any.
void add_crossings(Lines& lines, const Json& report) {
  const Json& crossings = table_of(report, "crossings");
  const long long pairs = count_of(crossings, "pairs");
  if (!pairs) return;
  std::string line = "look at: " + counted(pairs, "pair") + " of faces cross";
  if (crossings.contains("new")) line += ", " + std::to_string(count_of(crossings, "new")) + " of them new";
  if (const Json& places = list_of(crossings, "places"); !places.empty())
    line += ", most at (" + number(value_of(places[0], "x")) + ", " + number(value_of(places[0], "y")) +
            ", " + number(value_of(places[0], "z")) + ") m";
  lines.push_back(line);
}

std::string name_of_line(const Json& line) {
  const std::string name = text_of(line, "name");
  return name.empty() ? "line " + std::to_string(count_of(line, "id")) : name;
}

/// "chest +7.9 cm, waist +31.9 cm"
std::string ease_text(const Json& fit) {
  std::string text;
  for (const Json& e : list_of(fit, "ease")) {
    const double ease = value_of(e, "ease");
    if (!std::isfinite(ease)) continue;
    char part[64];
    std::snprintf(part, sizeof part, " %+.1f cm", 100 * ease);
    text += (text.empty() ? "" : ", ") + text_of(e, "section") + part;
  }
  return text;
}

void add_fit(Lines& lines, const Json& fit) {
  const Json& strain = table_of(fit, "strain");
  const Json& distance = table_of(fit, "distance");
  if (!strain.empty())
    lines.push_back("strain: " + per_cent(value_of(strain, "share_over")) + " of the cloth over " +
                    per_cent(value_of(strain, "over")) + ", at most " + per_cent(value_of(strain, "max")));
  if (!distance.empty())
    lines.push_back("distance to the body: " + length(distance, "min") + " to " + length(distance, "p95") +
                    ", half of the cloth nearer than " + length(distance, "median"));
  if (const std::string ease = ease_text(fit); !ease.empty()) lines.push_back("ease: " + ease);
  if (const long long faces = count_of(distance, "pierced_faces"))
    lines.push_back("look at: the body comes through " + counted(faces, "face") + ", by up to " +
                    length(distance, "deepest_penetration"));
}

std::string faults_of(const Json& report) {
  std::string faults;
  const auto add = [&](long long n, const std::string& what) {
    if (n) faults += (faults.empty() ? "" : ", ") + counted(n, what);
  };
  add(count_of(report, "degenerate_faces"), "degenerate face");
  if (const long long n = count_of(report, "self_intersections"))
    faults += (faults.empty() ? "" : ", ") + counted(n, "pair") + " of faces that cross";
  if (report.contains("self_intersections") && report["self_intersections"].is_null())
    faults += (faults.empty() ? "" : ", ") + std::string("too many faces at one place");
  if (report.contains("manifold") && report["manifold"] == false)
    faults += (faults.empty() ? "" : ", ") + std::string("not manifold");
  return faults;
}

std::string joined(const Json& list, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, list.size()); ++i)
    text += (i ? ", " : "") + (list[i].is_string() ? list[i].get<std::string>() : list[i].dump());
  return text + (list.size() > most ? " and " + std::to_string(list.size() - most) + " more" : "");
}

std::string repairs_of(const Json& report) {
  std::string text;
  for (const auto& [key, n] : table_of(report, "repairs").items()) {
    if (!n.is_number() || n == 0 || key == "triangulated_faces") continue;
    std::string words = key;
    std::replace(words.begin(), words.end(), '_', ' ');
    text += (text.empty() ? "" : ", ") + n.dump() + " " + words;
  }
  return text;
}

/// "not refined", "refined once", "refined 3 times".
std::string refined(long long times) {
  return times == 0   ? "not refined"
         : times == 1 ? "refined once"
                      : "refined " + std::to_string(times) + " times";
}

/// "waist +4.1 +- 0.2 cm", and so on, over all starts.
void add_starts(Lines& lines, const Json& report) {
  const Json& starts = table_of(report, "starts");
  if (starts.empty()) return;
  std::string text = std::to_string(count_of(starts, "resting")) + " of " +
                     std::to_string(count_of(starts, "asked")) + " starts at rest, that of start " +
                     std::to_string(count_of(starts, "chosen")) + " taken";
  for (const Json& s : list_of(starts, "spread")) {
    const std::string name = text_of(s, "name");
    const bool ease = name.rfind("ease_", 0) == 0;
    char part[96];
    if (ease)
      std::snprintf(part, sizeof part, "; %s %+.1f +- %.2f cm", name.c_str() + 5, 100 * value_of(s, "mean"),
                    100 * value_of(s, "deviation"));
    else if (name == "hem_height")
      std::snprintf(part, sizeof part, "; hem at %.1f +- %.2f cm", 100 * value_of(s, "mean"),
                    100 * value_of(s, "deviation"));
    else if (name == "energy")
      std::snprintf(part, sizeof part, "; energy %.4g +- %.2g J", value_of(s, "mean"),
                    value_of(s, "deviation"));
    else
      continue;
    text += part;
  }
  lines.push_back(text);
}

/// "brought from anna.obj: height x 1.03, arms turned by 28 degrees, legs by 8; moved by 7 cm, …".
void add_placed(Lines& lines, const Json& placed) {
  if (placed.empty()) return;
  const Json& turned = table_of(placed, "turned");
  const auto degrees = [&](const char* left, const char* right) {
    const double most = std::fmax(value_of(turned, left), value_of(turned, right));
    return std::to_string(std::lround(std::isfinite(most) ? most : 0)) + " degrees";
  };
  char scale[32];
  std::snprintf(scale, sizeof scale, "%.3g", value_of(placed, "height_scale"));
  lines.push_back("brought from " + text_of(placed, "made_for") + ": height x " + scale +
                  ", arms turned by " + degrees("left_arm", "right_arm") + ", legs by " +
                  degrees("left_leg", "right_leg") + "; moved by " + length(placed, "mean_move") +
                  ", at most " + length(placed, "farthest_move") + "; " +
                  per_cent(value_of(placed, "inside_share")) + " of it began inside the body");
}

/// Of one garment on a body.
void add_draped(Lines& lines, const Json& report) {
  const Json& levels = list_of(report, "levels");
  const long long vertices = levels.empty() ? 0 : count_of(levels.back(), "vertices");
  const Json& local = table_of(report, "local");
  lines.push_back(text_of(report, "garment") + ": " + text_of(report, "outcome") + " (" +
                  std::to_string(vertices) + " vertices, " +
                  (local.empty() ? refined(count_of(report, "subdivide"))
                                 : "refined where it folds; as fine everywhere, " +
                                       std::to_string(count_of(local, "uniform_vertices"))) +
                  ", " + number(value_of(report, "seconds")) + " s)");
  if (!report.contains("fit")) return lines.push_back("not measured: `furrow fit` measures what was written");
  const std::string asked = length(report, "gap_asked"), taken = length(report, "gap");
  if (table_of(table_of(report, "fit"), "distance").empty())
    lines.push_back("no body: it hangs from its pins");
  else
    lines.push_back("gap: " + asked + " asked, " + (taken == asked ? "" : taken + " aimed at, ") +
                    length(table_of(table_of(report, "fit"), "distance"), "min") + " at the nearest place; " +
                    std::to_string(count_of(report, "touching")) + " vertices touch the body");
  add_placed(lines, table_of(report, "placed"));
  add_starts(lines, report);
  add_fit(lines, table_of(report, "fit"));
  if (const Json& contact = table_of(report, "self_contact"); contact.contains("crossings_without"))
    lines.push_back("cloth keeps off cloth: without that " +
                    counted(count_of(contact, "crossings_without"), "pair") + " of faces crossed");
  add_crossings(lines, report);
}

/// Of parts of the processor time, the largest first, without what rounds to nothing.
std::string shares_of(const Json& times) {
  std::vector<std::pair<double, std::string>> parts;
  for (const auto& [name, part] : times.items())
    if (value_of(part, "share") >= 0.005) parts.emplace_back(-value_of(part, "share"), name);
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string text;
  for (const auto& [share, name] : parts)
    text += (text.empty() ? "" : ", ") + name + " " + std::to_string(std::lround(-100 * share)) + " %";
  std::replace(text.begin(), text.end(), '_', '-');
  return text;
}

/// "size: 1 m x 2 m x 0 mm (width, height, depth)".
std::string size_of_box(const Json& report) {
  const Json& box = table_of(report, "bounding_box");
  if (!box.contains("min") || !box.contains("max")) return "";
  std::string size;
  for (int k = 0; k < 3; ++k)
    size += (k ? " x " : "") + length_text(box["max"][k].get<double>() - box["min"][k].get<double>());
  return "size: " + size + " (width, height, depth)";
}

}  // namespace

Lines info_lines(const Json& report) {
  Lines lines;
  if (const Json& chain = table_of(report, "chain"); !chain.empty())
    return {"a chain: " + counted(count_of(chain, "links"), "link") + ", " + length(chain, "length") +
                " long; " + std::to_string(count_of(report, "vertices")) + " vertices, no faces",
            size_of_box(report), "furrow simulate moves it, and --settle brings it to rest",
            "no faults found"};
  lines.push_back(counted(count_of(report, "faces"), "face") + ", " +
                  std::to_string(count_of(report, "vertices")) + " vertices, " +
                  counted(count_of(report, "components"), "part") + ", " +
                  (report.value("closed", false) ? std::string("closed")
                                                 : counted(count_of(report, "boundary_loops"), "border")));
  if (const std::string size = size_of_box(report); !size.empty())
    lines.push_back(size + ", area " + number(value_of(report, "area")) + " m^2");
  lines.push_back("edges: " + length(report, "mean_edge_length") + " on average; smallest angle " +
                  number(value_of(report, "min_angle_deg")) + " degrees");
  if (const Json& borders = list_of(report, "borders"); !borders.empty()) {
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(5, borders.size()); ++i)
      text += (i ? ", " : "") + length(borders[i], "length");
    if (borders.size() > 5) text += " and " + std::to_string(borders.size() - 5) + " more";
    lines.push_back("borders: " + text + " long");
  }
  std::string carries;
  for (const char* key : {"groups", "materials", "lines"})
    if (const Json& list = list_of(report, key); !list.empty())
      carries += (carries.empty() ? "" : "; ") + std::string(key) + " " + joined(list, 4);
  if (report.value("texture_coordinates", false))
    carries += (carries.empty() ? "" : "; ") + std::string("texture coordinates");
  if (!carries.empty()) lines.push_back("carries: " + carries);
  if (const std::string repairs = repairs_of(report); !repairs.empty())
    lines.push_back("mended while it was read: " + repairs);
  const std::string faults = faults_of(report);
  lines.push_back(faults.empty() ? "no faults found" : "look at: " + faults);
  return lines;
}

Lines doctor_lines(const Json& report) {
  const bool repaired = report.contains("left");
  const Json &found = list_of(report, "found"), &left = repaired ? list_of(report, "left") : found;
  Lines lines;
  if (repaired && !found.empty())
    lines.push_back("looked through: " + counted((long long)(found.size()), "fault") + " before, " +
                    std::to_string(left.size()) + " left");
  for (const Json& sentence : left)
    if (sentence.is_string())
      lines.push_back((repaired ? "left: " : "found: ") + sentence.get<std::string>());
  if (left.empty()) lines.push_back(repaired && !found.empty() ? "well now" : "well: no faults found");
  std::string size;
  for (const Json& edge : list_of(report, "size"))
    size += (size.empty() ? "" : " x ") + length_text(edge.get<double>());
  lines.push_back(counted(count_of(report, "faces"), "face") + ", " +
                  counted(count_of(report, "components"), "part") + ", " +
                  (report.value("closed", false) ? std::string("closed")
                                                 : counted(count_of(report, "boundary_loops"), "border")) +
                  "; " + size + " (width, height, depth)");
  return lines;
}

Lines subdivide_lines(const Json& report) {
  Lines lines{"refined to " + std::to_string(count_of(report, "vertices")) + " vertices, " +
              std::to_string(count_of(report, "faces")) + " faces"};
  if (report.contains("inserted"))
    lines.push_back(std::to_string(count_of(report, "inserted")) +
                    " vertices inserted along the strokes; smallest angle " +
                    number(value_of(report, "min_angle_deg")) + " degrees");
  if (const std::size_t n = list_of(report, "line_edges_missing").size())
    lines.push_back("look at: " + counted(static_cast<long long>(n), "edge") +
                    " of the lines could not be made");
  return lines;
}

Lines smooth_lines(const Json& report) {
  return {"smoothed " + std::to_string(count_of(report, "vertices")) + " vertices in " +
          counted(count_of(report, "iterations"), "pair") + " of steps"};
}

/// What lines keep of their height, and how they are pressed.
void add_heights(Lines& lines, const Json& report) {
  constexpr std::size_t most = 4;
  std::string kept;
  std::size_t known = 0;
  for (const Json& line : list_of(report, "lines")) {
    if (!std::isfinite(value_of(line, "kept")) || ++known > most) continue;
    kept += (kept.empty() ? "" : ", ") + name_of_line(line) + " " + per_cent(value_of(line, "kept"));
    if (line.contains("press")) kept += " pressed x" + number(value_of(line, "press"));
  }
  if (known > most) kept += " and " + std::to_string(known - most) + " more";
  if (!kept.empty()) lines.push_back("lines keep of their height: " + kept);
}

Lines wrinkle_lines(const Json& report) {
  const Json& drawn = list_of(report, "lines");
  Lines lines{counted(static_cast<long long>(drawn.size()), "line") + " drawn, " +
              std::to_string(count_of(report, "inserted")) + " vertices inserted; smallest angle " +
              number(value_of(report, "min_angle_deg")) + " degrees"};
  const std::size_t most = 4;
  for (std::size_t i = 0; i < std::min(most, drawn.size()); ++i) {
    const Json& line = drawn[i];
    const std::string asked = name_of_line(line) + ": asked " + length(line, "height");
    lines.push_back(line.contains("crest_height") ? asked + ", " + length(line, "crest_height") +
                                                        " at the crest, " + length(line, "width") + " wide"
                                                  : asked + ", drawn " + length(line, "drawn_height") +
                                                        ", smoothed to " + length(line, "smoothed_height"));
  }
  if (drawn.size() > most)
    lines.push_back("and " + counted(static_cast<long long>(drawn.size() - most), "more line"));
  if (const std::size_t n = list_of(report, "line_edges_missing").size())
    lines.push_back("look at: " + counted(static_cast<long long>(n), "edge") +
                    " of the lines could not be made");
  if (const Json& kept = table_of(report, "kept"); !kept.empty())
    lines.push_back(balance_of(kept, "kept: ", "the drawn shape"));
  add_crossings(lines, report);
  if (const Json& rest = table_of(report, "at_rest"); !rest.empty()) {
    lines.push_back("then " + text_of(rest, "outcome") + " (" + number(value_of(rest, "seconds")) +
                    " s); angle defect " + number(value_of(rest, "angle_defect")) + " rad/m^2");
    add_heights(lines, rest);
  }
  return lines;
}

Lines strokes_lines(const Json& report) {
  const Json& strokes = list_of(report, "strokes");
  Lines lines{counted(static_cast<long long>(strokes.size()), "stroke")};
  for (const Json& stroke : strokes) {
    const std::string unit = text_of(stroke, "unit");
    std::string line = (text_of(stroke, "name").empty() ? "(no name)" : text_of(stroke, "name")) +
                       ": height " + length(stroke, "height");
    if (stroke.contains("width")) line += ", width " + length(stroke, "width");
    if (stroke.contains("length_on_garment"))
      line += ", " + length(stroke, "length_on_garment") + " long on the garment";
    else if (unit == "m")
      line += ", " + length(stroke, "length") + " long";
    line += ", drawn as " + text_of(stroke, "kind");
    if (stroke.value("closed", false)) line += ", closed";
    lines.push_back(line);
  }
  return lines;
}

/// How people read a measure of a cloth's quality. `each`: what follows each number; "%": it is a share.
/// `end`: what follows the last one.
struct MeasureWords {
  std::string title, each = "", end = "";
};

/// A measure that has no words yet shows its own name and bare numbers.
MeasureWords words_of_measure(const std::string& name) {
  static const std::map<std::string, MeasureWords> known{
      {"crest_ripple", {"crest ripples by", "%"}},
      {"lateral", {"crest beside its stroke", "%", " of the width"}},
      {"sweep", {"sections waver by", "%"}},
      {"normals_deg", {"normals turn by", " degrees"}},
      {"fit", {"section off its shape by", "%"}},
      {"angle_defect", {"knobs", "", " rad/m^2"}},
      {"min_angle_deg", {"smallest angle", " degrees"}},
      {"hem_turn_deg", {"hem turns over 6 mm by", " degrees"}},
      {"vertex_ratio", {"vertices", "", " times as many"}}};
  const auto found = known.find(name);
  return found == known.end() ? MeasureWords{name} : found->second;
}

/// A measure beside its target: "0.2 % of at most 0.3 %".
std::string measured_text(const Json& m, const MeasureWords& of) {
  if (!std::isfinite(value_of(m, "value"))) return "not measured: " + text_of(m, "why");
  const auto text = [&](double v) { return of.each == "%" ? per_cent(v) : number(v) + of.each; };
  std::string words = text(value_of(m, "value"));
  for (const auto& [key, bound] : {std::pair("at_most", " of at most "), {"at_least", " of at least "}})
    if (m.contains(key)) words += bound + text(value_of(m, key));
  words += of.end;
  if (!text_of(m, "line").empty()) words += " (" + text_of(m, "line") + ")";
  if (!text_of(m, "why").empty()) words += ": " + text_of(m, "why");
  return words;
}

Lines quality_lines(const Json& report) {
  Lines lines;
  std::string unknown;  // what has one reason is told together
  std::string why;
  for (const Json& m : list_of(report, "measures")) {
    if (!std::isfinite(value_of(m, "value")) && (why.empty() || why == text_of(m, "why"))) {
      why = text_of(m, "why");
      unknown += (unknown.empty() ? "" : ", ") + text_of(m, "id");
      continue;
    }
    const MeasureWords words = words_of_measure(text_of(m, "name"));
    lines.push_back(text_of(m, "id") + " " + words.title + ": " + measured_text(m, words) +
                    (m.value("met", true) ? "" : "  MISSED"));
  }
  if (!unknown.empty()) lines.insert(lines.begin(), unknown + " not measured: " + why);
  for (std::size_t i = most_lines; i < lines.size(); ++i) lines[most_lines - 1] += "; " + lines[i];
  lines.resize(std::min(lines.size(), most_lines));
  return lines;
}

/// "implicit step", "leapfrog step": one of a run's.
std::string step_of(const Json& report) { return text_of(report, "integrator") + " step"; }

/// Where the energy of implicit steps went; "" where none was lost.
std::string losses_of(const Json& balance) {
  const Json& lost = table_of(balance, "lost");
  const double air = value_of(lost, "air"), steps = value_of(lost, "steps"), off = std::abs(steps);
  if (!(air + off > 0)) return "";
  const auto joules = [](double energy) { return number(1000 * energy) + " mJ"; };
  std::string line = "energy lost: " + joules(air) + " to the air; the steps " +
                     (steps < 0 ? "made " : "took ") + joules(off);
  if (off > most_off_by_steps * (air + off)) line += " (less with a shorter --dt)";
  return line;
}

Lines simulate_lines(const Json& report) {
  Lines lines;
  lines.push_back((text_of(report, "title").empty() ? "" : text_of(report, "title") + ": ") +
                  text_of(report, "outcome") + " at " + number(value_of(report, "time")) + " s, " +
                  counted(count_of(report, "steps"), step_of(report)) + " of " +
                  number(value_of(report, "dt")) + " s (" + number(value_of(report, "seconds")) +
                  " s of work)");
  const Json& strain = table_of(report, "strain");
  lines.push_back("strain: " + per_cent(value_of(strain, "p99")) +
                  " and less in 99 % of the cloth, at most " + per_cent(value_of(strain, "max")));
  if (const Json& rest = table_of(report, "at_rest"); !rest.empty())
    lines.push_back(std::string(rest.value("converged", false) ? "at rest" : "not at rest") +
                    " before it moved, after " + counted(count_of(rest, "iterations"), "iteration") + " (" +
                    number(value_of(rest, "seconds")) + " s); angle defect " +
                    number(value_of(rest, "angle_defect_before")) + " drawn, " +
                    number(value_of(rest, "angle_defect")) + " rad/m^2 at rest");
  if (report.contains("contact_gap"))
    lines.push_back("body: gap " + length(report, "contact_gap") + ", " +
                    std::to_string(count_of(report, "contacts")) + " vertices in contact, " +
                    std::to_string(count_of(report, "vertices_inside")) + " inside");
  add_heights(lines, report);
  if (const std::string lost = losses_of(table_of(report, "balance")); !lost.empty()) lines.push_back(lost);
  if (const Json& choice = table_of(report, "choice"); !choice.empty())
    lines.push_back(text_of(choice, "says"));
  if (report.contains("times")) lines.push_back("processor time: " + shares_of(report["times"]));
  add_crossings(lines, report);
  return lines;
}

Lines keep_lines(const Json& report) {
  const Json& drawn = list_of(report, "lines");
  const auto fails = [](const Json& line) { return text_of(line, "verdict").rfind("held", 0) != 0; };
  const auto count = [&](const char* verdict) {
    return std::count_if(drawn.begin(), drawn.end(),
                         [&](const Json& line) { return text_of(line, "verdict") == verdict; });
  };
  const auto n = std::count_if(drawn.begin(), drawn.end(), fails);
  const auto in_calm = count("may hold"), open = count("not known");
  Lines lines{std::to_string(drawn.size() - static_cast<std::size_t>(n)) + " of " +
              counted(static_cast<long long>(drawn.size()), "line") + " will hold" +
              (in_calm > 0 ? ", " + std::to_string(in_calm) + " more where nothing blows" : "") +
              (open > 0 ? ", of " + std::to_string(open) + " it is not known" : "")};
  for (const bool failing : {true, false})  // what fails first
    for (const Json& line : drawn)
      if (fails(line) == failing)
        lines.push_back(name_of_line(line) + ": " + text_of(line, "words") + " (asked " +
                        length(line, "asked") + ", drawn " + length(line, "smoothed") + ", left " +
                        length_or_unknown(value_of(line, "height") * value_of(line, "kept")) + ")");
  if (lines.size() > 6) {
    const std::size_t more = lines.size() - 5;
    lines.resize(5);
    lines.push_back("and " + counted(static_cast<long long>(more), "more line"));
  }
  lines.push_back(balance_of(report, "", "the shape"));
  add_crossings(lines, report);
  return lines;
}

Lines chart_lines(const Json& report) {
  Lines lines{text_of(report, "says")};
  std::vector<const Json*> good;
  for (const Json& c : list_of(report, "candidates"))
    if (text_of(c, "verdict") == "meets") good.push_back(&c);
  std::stable_sort(good.begin(), good.end(),
                   [](const Json* a, const Json* b) { return value_of(*a, "cost") < value_of(*b, "cost"); });
  const std::size_t most = 4;
  for (std::size_t i = 0; i < std::min(most, good.size()); ++i)
    lines.push_back(text_of(*good[i], "name") + ": error " + per_cent(value_of(*good[i], "error")) + ", " +
                    number(value_of(*good[i], "cost")) + " s a simulated second");
  const std::size_t missed = list_of(report, "candidates").size() - good.size();
  std::string rest =
      good.size() > most ? std::to_string(good.size() - most) + " more are accurate enough" : "";
  if (missed) rest += (rest.empty() ? "" : ", ") + std::to_string(missed) + " are not, or were not run";
  if (!rest.empty()) lines.push_back(rest);
  return lines;
}

Lines sdf_lines(const Json& report) {
  Lines lines{"field of " + std::to_string(count_of(report, "samples")) + " samples, " +
              number(1e-6 * value_of(report, "bytes")) + " MB, in " + number(value_of(report, "seconds")) +
              " s"};
  const Json& error = table_of(report, "error");
  lines.push_back("error: " + length(error, "mean") + " on average, at most " + length(error, "max") + "; " +
                  length(report, "tolerance") + " asked");
  if (const Json& at = table_of(report, "at"); !at.empty())
    lines.push_back("there: distance " + length(at, "distance") + ", exactly " +
                    length(at, "exact_distance"));
  return lines;
}

Lines render_lines(const Json& report) {
  Lines lines{"picture of " + std::to_string(count_of(report, "width")) + " x " +
              std::to_string(count_of(report, "height")) + " pixels"};
  if (const long long n = count_of(report, "crossing_pairs"))
    lines.push_back("look at: " + counted(n, "pair") + " of faces cross, in magenta");
  return lines;
}

Lines drape_lines(const Json& report) {
  Lines lines;
  const Json& garments = list_of(report, "garments");
  if (garments.empty()) {
    add_draped(lines, report);
    return lines;
  }
  for (const Json& d : garments) {
    if (!d.contains("fit")) {
      add_draped(lines, d);
      continue;
    }
    const Json& strain = table_of(table_of(d, "fit"), "strain");
    lines.push_back(text_of(d, "garment") + ": " + text_of(d, "outcome") + "; " +
                    per_cent(value_of(strain, "share_over")) + " of the cloth strained over " +
                    per_cent(value_of(strain, "over")) +
                    (table_of(d, "fit").value("body_height", Json()).is_null()
                         ? ""
                         : "; ease " + ease_text(table_of(d, "fit"))));
  }
  for (const Json& p : list_of(table_of(report, "layers"), "pairs")) {
    const double compared = value_of(p, "compared");
    lines.push_back(text_of(p, "outer") + " over " + text_of(p, "inner") + ": " +
                    counted(count_of(p, "crossings"), "pair") + " of faces cross, " +
                    std::to_string(count_of(p, "crossings_at_start")) + " as given" +
                    (compared > 0
                         ? "; order kept at " + per_cent(value_of(p, "outside") / compared) + " of " +
                               std::to_string(count_of(p, "compared")) + " vertices that are near"
                         : ""));
  }
  return lines;
}

Lines fit_lines(const Json& report) {
  Lines lines;
  const Json& garments = list_of(report, "garments");
  if (garments.empty()) {
    add_fit(lines, report);
    for (const char* key : {"tight_zones", "loose_zones"})
      if (const Json& zones = list_of(report, key); !zones.empty())
        lines.push_back("look at: " + counted(static_cast<long long>(zones.size()), "zone") + " that " +
                        (zones.size() == 1 ? "is " : "are ") + std::string(key).substr(0, 5) +
                        ", the largest at " + per_cent(value_of(zones[0], "height_share")) +
                        " of the body's height, " + text_of(zones[0], "side"));
    add_crossings(lines, report);
    return lines;
  }
  for (const Json& g : garments) {
    const Json& strain = table_of(g, "strain");
    lines.push_back(text_of(g, "garment") + ": " +
                    (strain.empty()
                         ? std::string("strain unknown")
                         : per_cent(value_of(strain, "share_over")) + " of the cloth strained over " +
                               per_cent(value_of(strain, "over"))) +
                    "; ease " + ease_text(g));
  }
  return lines;
}

Lines transfer_lines(const Json& report) {
  Lines lines{std::to_string(count_of(report, "vertices")) + " vertices moved to the wrinkled shape, " +
              std::to_string(count_of(report, "unchanged")) + " of them unchanged"};
  if (const long long n = count_of(report, "interpolated"))
    lines.push_back(std::to_string(n) + " of them by the nearest place, at most " +
                    length(report, "max_distance") + " away");
  add_crossings(lines, report);
  return lines;
}

Lines bake_lines(const Json& report) {
  Lines lines{"maps of " + std::to_string(count_of(report, "size")) + " x " +
              std::to_string(count_of(report, "size")) + " texels, " +
              std::to_string(count_of(report, "covered_texels")) + " covered; displacement at most " +
              length(report, "largest_displacement")};
  for (const auto& [key, words] : {std::pair("unmatched_texels", "texels found no wrinkled mesh"),
                                   {"overlapping_texels", "texels lie in two charts"}})
    if (const long long n = count_of(report, key))
      lines.push_back("look at: " + std::to_string(n) + " " + words);
  if (const Json& check = table_of(report, "check"); !check.empty()) {
    const Json& to_high = table_of(check, "to_high");
    lines.push_back("check: the map's surface lies " + length(to_high, "median") + " (median) to " +
                    length(to_high, "max") + " from the wrinkled mesh");
  }
  return lines;
}

void print_summary(std::ostream& out, const Summary& summary) {
  const std::size_t n = summary.lines.size(), shown = n > most_lines ? most_lines - 1 : n;
  for (std::size_t i = 0; i < shown; ++i) out << summary.lines[i] << "\n";
  if (shown < n) out << "and " << n - shown << " lines more, with -v\n";
  std::string written;
  for (const std::string& file : summary.written)
    if (!file.empty() && file != "-") written += (written.empty() ? "" : ", ") + file;
  if (!written.empty()) out << "written: " << written << "\n";
  if (std::ranges::any_of(summary.next, io::has_control_character)) return;  // no line can hold it
  for (std::size_t i = 0; i < summary.next.size(); ++i)
    out << (i == 0 ? "next: " : " ") << io::shell_word(summary.next[i]);
  if (!summary.next.empty()) out << "\n";
}

}  // namespace furrow::cli
