// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/mesh_formats.h"

#include <algorithm>

#include "geometry/mesh/errors.h"
#include "io/base/figure_path.h"
#include "io/mesh/gltf_source.h"
#include "io/mesh/mesh_readers.h"
#include "io/mesh/mesh_writers.h"

namespace furrow::io {

// What only the table calls; each is defined, and told of, in the source of its format.
MeshFile read_off(std::string_view text, const std::string& name, const ReadOptions& options);
MeshFile read_stl(std::string_view text, const std::string& name, const ReadOptions& options);
void write_off(std::ostream& out, const MeshFile& file, const WriteOptions& options);
void write_stl(std::ostream& out, const MeshFile& file, const WriteOptions& options);
bool is_own_obj(std::string_view head, std::string_view tail);
bool is_own_ply(std::string_view head, std::string_view tail);
bool is_own_off(std::string_view head, std::string_view tail);
bool is_own_stl(std::string_view head, std::string_view tail);
bool is_own_glb(std::string_view head, std::string_view tail);

namespace {

using Lost = std::vector<std::string>;

/// A writer that leaves out nothing of which it would tell, and has no use for the folder.
template <auto write>
Lost whole(std::ostream& out, const MeshFile& file, const WriteOptions& options,
           const std::filesystem::path&) {
  write(out, file, options);
  return {};
}

Lost obj(std::ostream& out, const MeshFile& file, const WriteOptions& options,
         const std::filesystem::path& folder) {
  write_obj(out, file, options, folder);
  return {};
}

Lost glb(std::ostream& out, const MeshFile& file, const WriteOptions& options, const std::filesystem::path&) {
  return write_glb(out, file, options);
}

/// A GLB by another name, which promises an avatar.
Lost vrm(std::ostream& out, const MeshFile& file, const WriteOptions& options, const std::filesystem::path&) {
  const std::string document = file.gltf ? file.gltf->document : "";
  if (document.find("\"VRM\":{") == document.npos && document.find("\"VRMC_vrm\":{") == document.npos)
    throw std::invalid_argument(
        "mesh: a vrm is an avatar, which none was read for; let the name end in .glb");
  return write_glb(out, file, options);
}

constexpr const char* other =
    "what an FBX or a COLLADA file has is written as a GLB; let its name end in .glb";

constexpr MeshEnding endings[] = {
    {".obj", MeshFormat::obj, true, read_obj, obj, "", is_own_obj},
    {".ply", MeshFormat::ply, true, read_ply, whole<write_ply>, "", is_own_ply},
    {".off", MeshFormat::off, true, read_off, whole<write_off>, "", is_own_off},
    {".stl", MeshFormat::stl, false, read_stl, whole<write_stl>, "", is_own_stl},
    {".gltf", MeshFormat::gltf, false, nullptr, nullptr,
     "a glTF is written as one file; let its name end in .glb"},
    {".glb", MeshFormat::gltf, false, nullptr, glb, "", is_own_glb},
    {".vrm", MeshFormat::gltf, false, nullptr, vrm, "", is_own_glb},
    {".fbx", MeshFormat::gltf, false, nullptr, nullptr, other},
    {".dae", MeshFormat::gltf, false, nullptr, nullptr, other}};

template <class Wanted>
std::string listed(const Wanted& wanted, const std::string& last) {
  std::vector<std::string_view> words;
  for (const MeshEnding& e : endings)
    if (wanted(e)) words.push_back(e.text.substr(1));
  std::string text(words[0]);
  for (std::size_t i = 1; i < words.size(); ++i) (text += i + 1 < words.size() ? ", " : last) += words[i];
  return text;
}

}  // namespace

std::span<const MeshEnding> mesh_endings() { return endings; }

const MeshEnding* find_mesh_ending(const std::filesystem::path& path) {
  const auto found = std::ranges::find(endings, ending_of(path), &MeshEnding::text);
  return found == std::end(endings) ? nullptr : found;
}

std::string mesh_formats(bool all, const std::string& last) {
  return listed([&](const MeshEnding& e) { return all || e.write; }, last);
}

std::string mesh_formats_in_order() {
  return listed([](const MeshEnding& e) { return e.keeps_order; }, " or ");
}

bool is_written_mesh(const std::string& ending) {
  return std::ranges::any_of(endings, [&](const MeshEnding& e) { return e.write && ending == e.text; });
}

MeshFormat mesh_format(const std::filesystem::path& path) {
  if (path == "-") return MeshFormat::obj;
  if (const MeshEnding* known = find_mesh_ending(path)) return known->format;
  const std::string ending = ending_of(path);
  throw geometry::ContentError(
      path.string() + ": unknown format '" + ending + "'; " + mesh_formats(true, " and ") + " are read, " +
      mesh_formats(false, " and ") + " written" +
      (ending == ".blend" || ending == ".usd" || ending == ".abc" ? "; export it as GLB or OBJ" : ""));
}

}  // namespace furrow::io
