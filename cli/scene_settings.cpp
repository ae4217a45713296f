// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/scene_settings.h"

namespace furrow::cli {

io::TomlDocument scene_settings(const std::string& in, const std::string& state_path,
                                const std::optional<io::SavedState>& state, const SceneFlags& flags,
                                const CommonArguments& common) {
  io::TomlDocument document;
  if (jobs::is_scene(in)) {
    document = io::read_toml(in);
  } else if (state) {
    if (!in.empty()) throw UsageError(in + ": --state has its garment; leave the mesh away");
    document = io::document_of(state->scene, state_path);
  } else {
    if (in.empty()) throw UsageError("name a garment, a scene (.toml), or --state");
    io::set_value(document, "garment.mesh", in, "the garment");
  }
  if (common.unit) io::set_value(document, "unit", *common.unit, "--unit");
  if (common.up) io::set_value(document, "up", *common.up, "--up");
  for (const char* list : {"lines", "pins"}) io::make_list(document, list);
  flags.apply(document);
  for (const char* list : {"lines", "pins"}) io::make_list(document, list);
  return document;
}

}  // namespace furrow::cli
