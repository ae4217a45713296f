// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/old_names.h"

#include <algorithm>

namespace furrow::cli {

const std::vector<OldName>& old_names() {
  using enum OldName::Values;
  static const std::vector<OldName> names{{"chart", "--tolerance", "--accuracy"},
                                          {"simulate", "--tolerance", "--accuracy", shares},
                                          {"fit", "--rest", "--rest-shape"},
                                          {"transfer", "--rest", "--rest-shape"},
                                          {"drape", "--compare", "--fabrics"},
                                          {"drape", "--iterations", "--max-iterations"},
                                          {"bake", "--size", "--texels"},
                                          {"render", "--parallel", "--orthographic"},
                                          {"drape", "--parallel", "--orthographic"},
                                          {"fit", "--parallel", "--orthographic"},
                                          {"keep", "--parallel", "--orthographic"},
                                          {"wrinkle", "--parallel", "--orthographic"},
                                          {"wrinkle", "--preview", "--picture"},
                                          {"sdf", "--slice", "--picture"},
                                          {"subdivide", "--loop", "--subdivide"},
                                          {"strokes", "--height", "--change", of_a_name},
                                          {"strokes", "--width", "--change", of_a_name},
                                          {"strokes", "--sharpness", "--change", of_a_name},
                                          {"strokes", "--press", "--change", of_a_name},
                                          {"strokes", "--taper", "--change", of_a_name},
                                          {"strokes", "--flare", "--change", of_a_name},
                                          {"strokes", "--smooth", "--change", of_a_name},
                                          {"strokes", "--set", "--change", of_a_name}};
  return names;
}

namespace {

/// "fold=0.1" as "fold.height=0.1".
std::string with_key(const std::string& value, const OldName& name) {
  const std::size_t at = value.rfind('=');
  if (at == std::string::npos) return value;
  return value.substr(0, at) + "." + (name.old_name + 2) + value.substr(at);
}

}  // namespace

PresentWords with_present_names(std::vector<std::string> words) {
  PresentWords result;
  if (words.empty()) return result;
  for (std::size_t i = 1; i < words.size() && words[i] != "--"; ++i) {
    const std::size_t equals = words[i].rfind("--", 0) == 0 ? words[i].find('=') : std::string::npos;
    const std::string option = words[i].substr(0, equals);
    for (const OldName& name : old_names()) {
      if (words[0] != name.command || option != name.old_name) continue;
      const bool has_next = equals == std::string::npos && i + 1 < words.size();
      std::string value = equals != std::string::npos ? words[i].substr(equals + 1)
                          : has_next                  ? words[i + 1]
                                                      : "";
      if (name.values == OldName::Values::shares && !value.ends_with('%')) continue;
      if (name.values == OldName::Values::of_a_name) value = with_key(value, name);
      words[i] = name.new_name + (equals != std::string::npos ? "=" + value : "");
      if (has_next) words[i + 1] = value;
      const std::string note =
          std::string("note: ") + name.old_name + " of furrow " + name.command + " is " + name.new_name +
          (name.values == OldName::Values::of_a_name ? std::string(" NAME.") + (name.old_name + 2) + "=VALUE"
                                                     : "") +
          " now; the old name goes with the next version";
      if (std::find(result.notes.begin(), result.notes.end(), note) == result.notes.end())
        result.notes.push_back(note);
      break;
    }
  }
  result.words = std::move(words);
  return result;
}

}  // namespace furrow::cli
