// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/doctor.h"

#include <algorithm>

#include "cli/camera_options.h"
#include "cli/card_options.h"
#include "cli/print_text.h"
#include "cli/subcommands.h"
#include "geometry/mesh/measures.h"
#include "io/picture/png_file.h"
#include "io/picture/render_scene.h"
#include "jobs/base/read_inputs.h"

namespace furrow::cli {
namespace {

struct DoctorArguments : CommonArguments {
  std::string mesh, picture;
  DoctorJob job;
  CameraArguments camera;
};

/// The mesh with a ball at each place where something is wrong.
void write_picture(const DoctorReport& report, const DoctorArguments& a) {
  io::RenderScene scene;
  scene.meshes.push_back(io::render_mesh_from(report.mesh.mesh, io::Style::cloth));
  for (const Ailment& ailment : report.repaired ? report.left : report.found)
    for (const geometry::Point& p : ailment.places)
      scene.lines.push_back({{{p.x(), p.y(), p.z()}}, io::ridge_colour, 4});
  const io::RenderOptions options = render_options({&scene, 1}, a.camera);
  io::write_png(a.picture, io::render(scene, options));
  save_camera(options, a.camera);
}

/// For people: a sentence an ailment.
Json sentences(Json report) {
  for (const char* list : {"found", "left"}) {
    if (!report.contains(list)) continue;
    Json words = Json::array();
    for (const Json& a : report[list]) {
      std::string text = a["text"];
      const std::string help = a["help"];
      if (!help.empty() && worded(text).find(worded(help)) == std::string::npos) text += "; " + help;
      words.push_back(text);
    }
    report[list] = words;
  }
  return report;
}

/// What to call next: the mend, or the use of what is well.
std::vector<std::string> next_of(const DoctorReport& report, const DoctorArguments& a) {
  const auto mendable = [](const Ailment& ailment) { return ailment.mendable; };
  if (!report.repaired && std::any_of(report.found.begin(), report.found.end(), mendable))
    return a.job.is_body
               ? std::vector<std::string>{"furrow",   "doctor", a.mesh,      "--as-body",
                                          "--repair", "-o",     "mended.obj"}
               : std::vector<std::string>{"furrow", "doctor", a.mesh, "--repair", "-o", "mended.obj"};
  if (!report.well() || a.job.is_body) return {};
  const std::string mesh = a.out.empty() || a.out == "-" ? a.mesh : a.out;
  if (!a.job.body) return {"furrow", "wrinkle", mesh, "LINES", "-o", "wrinkled.ply"};
  return {"furrow", "drape", mesh, "--body", name_of(*a.job.body, ""), "-o", "draped.ply"};
}

Lines doctor_lines(const Json& report) {
  const bool repaired = report.contains("left");
  const Json &found = list_of(report, "found"), &left = repaired ? list_of(report, "left") : found;
  Lines lines;
  if (repaired && !found.empty())
    lines.push_back("looked through: " + counted(found.size(), "fault") + " before, " +
                    std::to_string(left.size()) + " left");
  for (const Json& sentence : left)
    if (sentence.is_string())
      lines.push_back((repaired ? "left: " : "found: ") + sentence.get<std::string>());
  if (left.empty()) lines.push_back(repaired && !found.empty() ? "well now" : "well: no faults found");
  std::string size;
  for (const Json& edge : list_of(report, "size"))
    size += (size.empty() ? "" : " x ") + geometry::length_text(edge.get<double>());
  lines.push_back(counted(count_of(report, "faces"), "face") + ", " +
                  counted(count_of(report, "components"), "part") + ", " +
                  (report.value("closed", false) ? std::string("closed")
                                                 : counted(count_of(report, "boundary_loops"), "border")) +
                  "; " + size + " (width, height, depth)");
  return lines;
}

int doctor(DoctorArguments& a) {
  check_picture(a.picture, "--picture");
  a.job.mesh = std::filesystem::path(a.mesh);
  a.job.frame = a;
  a.job.more_outputs = {a.picture, a.camera.save_camera};
  a.out = a.job.output.string();
  Terminal terminal(a);
  const DoctorReport report = jobs::doctor(a.job, terminal);
  if (a.out == "-") write_mesh(report.mesh, in_frame(a, report.frame));
  if (!a.picture.empty()) write_picture(report, a);
  Json json = a.json ? to_json(report) : sentences(to_json(report));
  const std::vector<std::string> lines = doctor_lines(json);
  if (!a.picture.empty()) json["picture"] = a.picture;
  if (!a.out.empty()) json["written"] = a.out;
  print_report(json, a, {lines, {a.picture, a.out}, next_of(report, a)});
  return exit_code_of(false, report.well());
}

void add_doctor(CLI::App& sub, DoctorArguments& a) {
  sub.add_option("mesh", a.mesh, "garment to examine; with --as-body a body")->required();
  add_card(sub, card(a.job));
  sub.add_option("--picture", a.picture, "PNG to write: a red ball where something is wrong");
  add_camera_options(sub, a.camera);
}

const Subcommand doctor_subcommand(
    20, "doctor",
    "Say what is wrong with a mesh, where, and what mends it; --repair does\n\n"
    "  furrow doctor shirt.obj --body body.obj --picture where.png\n"
    "  furrow doctor shirt.obj --repair -o mended.obj\n\n"
    "The exit code is 4 where something is wrong, or is left after --repair.",
    add_doctor, doctor);

}  // namespace
}  // namespace furrow::cli
