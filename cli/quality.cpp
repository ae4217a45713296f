// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/quality.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/camera_options.h"
#include "cli/card_options.h"
#include "cli/subcommands.h"
#include "io/picture/png_file.h"
#include "jobs/base/read_inputs.h"
#include "jobs/draw/quality_targets.h"

namespace furrow::cli {
namespace {

struct QualityArguments : CommonArguments {
  std::string mesh, picture;
  QualityJob job;
  bool check = false;
  CameraArguments camera;
};

void write_picture(const QualityReport& report, const QualityArguments& a) {
  const io::RenderScene scene = quality_scene(report);
  const io::RenderOptions options = render_options({&scene, 1}, a.camera);
  io::write_png(a.picture, io::render(scene, options));
  save_camera(options, a.camera);
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

int quality(QualityArguments& a) {
  check_picture(a.picture, "--picture");
  a.job.mesh = std::filesystem::path(a.mesh);
  a.job.frame = a;
  a.job.more_outputs = {a.picture, a.camera.save_camera};
  Terminal terminal(a);
  const QualityReport report = jobs::quality(a.job, terminal);
  if (!a.picture.empty()) write_picture(report, a);
  Json json = to_json(report);
  if (!a.picture.empty()) json["picture"] = a.picture;
  print_report(json, a, {quality_lines(json), {a.picture, a.camera.save_camera}, {}});
  return exit_code_of(false, !a.check || report.met());
}

void add_quality(CLI::App& sub, QualityArguments& a) {
  sub.add_option("mesh", a.mesh, "mesh to measure, with folds or without")->required();
  add_card(sub, card(a.job));
  sub.add_option("--picture", a.picture,
                 "PNG to write: angle defects as colours, red domes and blue saddles, full at 400 rad/m^2; a "
                 "magenta ball at the worst places beyond that");
  sub.add_flag("--check", a.check, "exit with 4 where a target is missed");
  add_camera_options(sub, a.camera);
}

const Subcommand quality_subcommand(
    70, "quality",
    "Measure how well a cloth is folded: ripples, zigzag, knobs, thin faces, hems\n\n"
    "  furrow quality wrinkled.ply\n"
    "  furrow quality wrinkled.obj --base skirt.obj --strokes lines.json --picture knobs.png\n"
    "  furrow quality worn.ply --check\n\n"
    "Each measure stands beside its target. The exit code is 0, with --check 4 where one is missed.",
    add_quality, quality);

}  // namespace
}  // namespace furrow::cli
