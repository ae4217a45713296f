// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/scene_flags.h"

#include "cli/common.h"
#include "cli/help.h"
#include "io/base/field_words.h"
#include "jobs/base/read_inputs.h"

namespace furrow::cli {
namespace {

/// "1,2,3" as a list, so that vectors need no brackets.
io::Json typed_value_of(const std::string& text, bool is_text) {
  if (is_text) return text;
  if (text.find(',') != std::string::npos && text.find('[') == std::string::npos)
    return io::parse_value("[" + text + "]");
  return io::parse_value(text);
}

/// "-o,--output": the output alone has a letter.
std::string flags_of(const io::Setting& s) {
  return (s.path == "output.mesh" ? "-o," : "") + io::flag_of(s.keyword);
}

std::string flag_name(const io::Setting& s) { return io::flag_of(s.keyword); }

/// The group of --help that the settings of this table belong in.
group group_of(const std::string& table, unsigned subcommand) {
  if (table == "material" || table == "garment") return group::cloth;
  if (table == "body" || table == "pins") return group::body;
  if (table == "output") return group::output;
  return subcommand & io::used_by::drape ? group::rest : group::motion;
}

void begin_group_of(CLI::App& sub, const io::Setting& s, unsigned subcommand) {
  begin_group(sub, group_of(s.table(), subcommand),
              s.shown_in & subcommand ? Audience::everyone : Audience::few);
}

void add_pins(io::TomlDocument& document, const char* kind, io::Json value, const std::string& flag) {
  const std::size_t n = document.root->contains("pins") ? document.root["pins"].size() : 0;
  io::set_value(document, "pins." + std::to_string(n), io::Json{{kind, std::move(value)}}, flag);
}

}  // namespace

void SceneFlags::add_to(CLI::App& sub, unsigned subcommand) {
  const auto has = [&](const io::Setting& s) { return !s.keyword.empty() && (s.flag_in & subcommand); };
  for (const io::Setting& s : io::scene_settings()) {
    if (!has(s) || s.kind == io::Kind::yes_no || s.table() == "pins") continue;
    Given& g = given_.emplace_back(Given{&s});
    begin_group_of(sub, s, subcommand);
    g.option = sub.add_option(flags_of(s), g.text, io::described(s, flag_name))
                   ->type_name(s.is_text() ? "TEXT" : "NUMBER");
  }
  for (const io::Setting& s : io::scene_settings()) {
    if (!has(s) || s.kind != io::Kind::yes_no) continue;
    Given& g = given_.emplace_back(Given{&s});
    begin_group_of(sub, s, subcommand);
    g.option = sub.add_flag(flags_of(s), g.is_on, io::described(s, flag_name));
  }
  add_pin_flags(sub, subcommand);
  const bool draws = subcommand & io::used_by::wrinkle;
  begin_group(sub, draws ? group::cloth : group_of("simulation", subcommand),
              draws ? Audience::few : Audience::everyone);
  sub.add_option("--set", sets_,
                 "any setting of a scene, as key=value: --set body.motion.spin.rate=3; may be given again")
      ->allow_extra_args(false);
}

void SceneFlags::add_pin_flags(CLI::App& sub, unsigned subcommand) {
  const auto add = [&](const char* path, auto& values) {
    const io::Setting& s = *io::find_setting(path);
    begin_group_of(sub, s, subcommand);
    return sub.add_option(flags_of(s), values, io::described(s, flag_name));
  };
  add("pins.box", pin_boxes_)->allow_extra_args(false);
  add("pins.loop", pin_loops_)->allow_extra_args(false);
  add("pins.group", pin_groups_)->allow_extra_args(false);
  add("pins.vertices", pin_vertices_)->delimiter(',')->allow_extra_args(false);
}

void SceneFlags::apply(io::TomlDocument& document) const {
  for (const Given& g : given_) {
    const io::Setting& s = *g.setting;
    if (!g.option->count()) continue;
    if (s.kind != io::Kind::yes_no)
      io::set_value(document, s.path, typed_value_of(g.text, s.is_text()), s.name());
    else if (g.is_on)
      io::set_value(document, s.path, true, s.name());
  }
  for (const std::string& box : pin_boxes_)
    add_pins(document, "box", parse_numbers(box, 6, "--pin-box"), "`pin_box=" + box + "`");
  for (const std::string& loop : pin_loops_) add_pins(document, "loop", loop, "`pin_loop=" + loop + "`");
  for (const std::string& group : pin_groups_)
    add_pins(document, "group", group, "`pin_group=" + group + "`");
  if (!pin_vertices_.empty()) add_pins(document, "vertices", pin_vertices_, "`pin_vertices`");
  apply_sets(document, sets_);
}

std::vector<std::string> SceneFlags::words(unsigned subcommand) const {
  std::vector<std::string> words;
  for (const Given& g : given_) {
    const io::Setting& s = *g.setting;
    if (!g.option->count() || !(s.flag_in & subcommand) || s.table() == "output") continue;
    words.push_back(flag_name(s));
    if (s.kind != io::Kind::yes_no) words.push_back(g.text);
  }
  const auto add = [&](const char* flag, const std::string& value) {
    words.insert(words.end(), {flag, value});
  };
  for (const std::string& box : pin_boxes_) add("--pin-box", box);
  for (const std::string& loop : pin_loops_) add("--pin-loop", loop);
  for (const std::string& group : pin_groups_) add("--pin-group", group);
  for (const int vertex : pin_vertices_) add("--pin-vertices", std::to_string(vertex));
  return words;
}

std::string SceneFlags::first() const {
  for (const Given& g : given_)
    if (g.option->count()) return io::flag_of(g.setting->keyword);
  if (!pin_boxes_.empty()) return "--pin-box";
  if (!pin_loops_.empty()) return "--pin-loop";
  if (!pin_groups_.empty()) return "--pin-group";
  return pin_vertices_.empty() ? "" : "--pin-vertices";
}

io::TomlDocument scene_settings(const std::string& in, const std::string& state_path,
                                const std::optional<io::SavedState>& state, const SceneFlags& flags,
                                const jobs::Frame& frame) {
  io::TomlDocument document = jobs::settings_of(in, state_path, state);
  if (frame.unit) io::set_value(document, "unit", *frame.unit, "`unit`");
  if (frame.up) io::set_value(document, "up", *frame.up, "`up`");
  for (const char* list : {"lines", "pins"}) io::make_list(document, list);
  flags.apply(document);
  for (const char* list : {"lines", "pins"}) io::make_list(document, list);
  return document;
}

void apply_sets(io::TomlDocument& document, const std::vector<std::string>& sets) {
  for (const std::string& text : sets) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError("--set takes key=value, not '" + text + "'");
    try {
      io::set_value(document, text.substr(0, equals), io::parse_value(text.substr(equals + 1)), "`set`");
    } catch (const std::invalid_argument& e) {
      throw UsageError(std::string("--set ") + e.what());
    }
  }
}

}  // namespace furrow::cli
