// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/part_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/mesh/property_names.h"

namespace furrow::jobs {
namespace {

constexpr int no_group = -1;

/// By part: the group of all its faces.
std::vector<int> groups_of(const io::MeshFile& file, const geometry::Parts& parts) {
  std::vector<int> groups(parts.list.size(), no_group);
  const auto group = geometry::find_map(file.mesh, geometry::attribute::group);
  if (!group) return groups;
  for (std::size_t part = 0; part < groups.size(); ++part) groups[part] = (*group)[parts.list[part].first];
  for (const geometry::Face f : file.mesh->faces())
    if (int& of = groups[std::size_t(parts.of_face[f.idx()])];
        of != (*group)[f] || of >= int(file.group_names.size()))
      of = no_group;
  return groups;
}

/// "part 2": its place in the order of first faces, which stays as lines are drawn and faces are refined.
std::string numbered(const geometry::Parts& parts, int part) {
  const geometry::Face first = parts.list[std::size_t(part)].first;
  const auto before = std::count_if(parts.list.begin(), parts.list.end(),
                                    [&](const geometry::Part& other) { return other.first < first; });
  return "part " + std::to_string(1 + before);
}

}  // namespace

std::string name_of_part(const io::MeshFile& file, const geometry::Parts& parts, int part) {
  if (parts.list.size() < 2) return "the garment";
  const geometry::Part& of = parts.list[std::size_t(part)];
  const std::string plain = fmt::format("{} ({} vertices)", numbered(parts, part), of.vertices);
  const auto group = geometry::find_map(file.mesh, geometry::attribute::group);
  const int name = group ? (*group)[of.first] : -1;
  if (name < 0 || std::size_t(name) >= file.group_names.size()) return plain;
  for (geometry::Face f : file.mesh->faces())
    if (((*group)[f] == name) != (parts.of_face[f.idx()] == part)) return plain;
  return "'" + file.group_names[std::size_t(name)] + "'";
}

std::string setting_name_of_part(const io::MeshFile& file, const geometry::Parts& parts, int part) {
  const std::string name = name_of_part(file, parts, part);
  return name.starts_with('\'') ? name.substr(1, name.size() - 2) : numbered(parts, part);
}

std::vector<int> parts_called(const io::MeshFile& file, const geometry::Parts& parts,
                              const std::string& name) {
  const std::vector<int> groups = groups_of(file, parts);
  std::vector<int> called;
  for (int part = 0; part < int(parts.list.size()); ++part) {
    const int group = groups[std::size_t(part)];
    const std::string number = numbered(parts, part);
    if ((group >= 0 && file.group_names[std::size_t(group)] == name) || name == number ||
        name.starts_with(number + " ("))
      called.push_back(part);
  }
  return called;
}

}  // namespace furrow::jobs
