// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/info.h"

#include <algorithm>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "geometry/mesh/measures.h"
#include "jobs/base/gate.h"
#include "jobs/base/read_inputs.h"

namespace furrow::cli {
namespace {

struct InfoArguments : CommonArguments {
  std::string mesh;
};

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

/// "size: 1 m x 2 m x 0 mm (width, height, depth)".
std::string size_of_box(const Json& report) {
  const Json& box = table_of(report, "bounding_box");
  if (!box.contains("min") || !box.contains("max")) return "";
  std::string size;
  for (int k = 0; k < 3; ++k)
    size +=
        (k ? " x " : "") + geometry::length_text(box["max"][k].get<double>() - box["min"][k].get<double>());
  return "size: " + size + " (width, height, depth)";
}

/// "parts: 'shirt'; 'pocket', lies on another".
std::string parts_of(const Json& report) {
  constexpr std::size_t most = 8;
  const Json& parts = list_of(report, "parts");
  std::string text;
  for (std::size_t i = 0; i < std::min(most, parts.size()); ++i)
    text += (i ? "; " : "parts: ") + parts[i].value("name", "") +
            (parts[i].value("goes", "") == "by itself" ? "" : ", lies on another");
  return text + (parts.size() > most ? " and " + std::to_string(parts.size() - most) + " more" : "");
}

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
  if (const std::string parts = parts_of(report); !parts.empty()) lines.push_back(parts);
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

void info(const InfoArguments& a) {
  Terminal terminal(a);
  const io::MeshFile file =
      jobs::read_mesh(std::filesystem::path(a.mesh), {a, terminal}, jobs::Chains::taken);
  const std::string odd = odd_size(file.mesh, "mesh", a);
  if (!odd.empty()) warn(a.mesh + ": " + odd, a);
  const Json json = jobs::info(file);
  std::vector<std::string> lines = info_lines(json);
  if (!odd.empty() && lines.back() == "no faults found") lines.back() = "look at: its size";
  print_report(json, a,
               {lines,
                {},
                odd.empty() ? std::vector<std::string>{}
                            : std::vector<std::string>{"furrow", "info", a.mesh, "--unit", "UNIT"}});
}

void add_info(CLI::App& sub, InfoArguments& a) {
  sub.add_option("mesh", a.mesh, "mesh to read: " + io::mesh_formats(true) + "; - is OBJ from standard input")
      ->required();
}

const Subcommand info_subcommand(10, "info", "Say what a mesh is: counts, topology, lengths, areas, faults",
                                 add_info, info);

}  // namespace
}  // namespace furrow::cli
