// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/keywords.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/base/nearest_word.h"
#include "io/scene/settings_schema.h"
#include "jobs/base/read_inputs.h"

namespace furrow::python {
namespace {

bool has_keyword(const io::Setting& s, unsigned subcommand) {
  return !s.keyword.empty() && (s.flag_in & subcommand);
}

/// Of a choice: its words, as the schema's range has them between backticks.
std::string literal_of(const std::string& range) {
  std::string list = range;
  std::replace(list.begin(), list.end(), '`', '"');
  return "Literal[" + list + "]";
}

std::string type_of(const io::Setting& s) {
  if (s.path == "pins.box") return "Sequence[float] | Sequence[Sequence[float]]";
  if (s.path == "pins.loop") return "str | int | Sequence[str | int]";
  if (s.path == "pins.group") return "str | Sequence[str]";
  if (s.path == "pins.vertices") return "int | Sequence[int]";
  if (s.path == "garment.mesh" || s.path == "body.mesh") return "Mesh | Path";
  if (s.path == "forces.gravity") return "float | Sequence[float]";
  if (s.path == "material.preset" || s.path == "material.warp") return "Path";  // a word, or a file
  switch (s.kind) {
    case io::Kind::number:
      return "float";
    case io::Kind::whole:
      return "int";
    case io::Kind::yes_no:
      return "bool";
    case io::Kind::choice:
      return literal_of(s.range);
    case io::Kind::path:
      return "Path";
    case io::Kind::vector:
      return "Sequence[float]";
    case io::Kind::list:
      return "Sequence[str]";
    case io::Kind::table:
      return "Mapping[str, Any]";
    case io::Kind::text:
      return "str";
  }
  return "Any";
}

/// Sets every value of a dict by its path; tables in tables are walked, lists are values.
void set_all(const Json& table, const std::string& above, const std::string& where,
             io::TomlDocument& document) {
  for (const auto& [key, value] : table.items()) {
    const std::string path = above.empty() ? key : above + "." + key;
    const io::Setting* known = io::find_setting(path);
    if (value.is_object() && !(known && known->kind == io::Kind::table))
      set_all(value, path, where, document);
    else if (!value.is_null())
      io::set_value(document, path, value, where);
  }
}

void make_lists(io::TomlDocument& document) {
  for (const char* list : {"lines", "pins"}) io::make_list(document, list);
}

/// The document of the scene, before keywords.
io::TomlDocument document_of(py::handle garment, CalledScene& scene, Memory& memory) {
  if (scene.state && !garment.is_none())
    throw std::invalid_argument("state: it has its garment; leave out the mesh");
  if (scene.state) return io::document_of(scene.state->scene, scene.state_path.string());
  if (garment.is_none()) throw std::invalid_argument("name a garment, a scene (.toml), or state");
  if (py::isinstance<py::dict>(garment)) {
    io::TomlDocument document;
    set_all(to_json({"scene", garment}, memory), "", "`scene`", document);
    return document;
  }
  if (py::isinstance<HeldMesh>(garment))
    return jobs::settings_of(memory.add(py::cast<const HeldMesh&>(garment), "garment"), "", std::nullopt);
  std::string path;
  if (!is_text(garment))
    Value{"garment", garment}.fail("a furrow.Mesh, the path of one or of a scene, or a dict");
  take(Value{"garment", garment}, path);
  scene.is_file = jobs::is_scene(path);
  if (scene.is_file) scene.input.folder = std::filesystem::path(path).parent_path();
  return jobs::settings_of(path, "", std::nullopt);
}

}  // namespace

Call::Call(py::dict keywords, py::object on_warning) {
  listener.on_warning = std::move(on_warning);
  for (const auto& [key, value] : keywords)
    if (!value.is_none())
      given_.emplace_back(py::cast<std::string>(key), py::reinterpret_borrow<py::object>(value));
  apply(keywords_of(jobs::common_card(frame, listener.force, listener.replace)));
  for (const auto& [name, value] : given_) {
    if (name != "progress" && name != "cancel") continue;
    if (!PyCallable_Check(value.ptr())) Value{name, value}.fail("callable");
    (name == "progress" ? listener.on_progress : listener.on_cancel) = value;
    used_.insert(name);
  }
}

py::object Call::value(const std::string& name) const {
  const auto found =
      std::find_if(given_.begin(), given_.end(), [&](const auto& g) { return g.first == name; });
  return found == given_.end() ? py::object() : found->second;
}

void Call::add_pins(const Value& value, const std::string& kind, io::TomlDocument& document,
                    Memory& memory) const {
  const Json given = to_json(value, memory);
  const bool is_one =
      !given.is_array() || given.empty() || (kind == "box" && !given[0].is_array()) || kind == "vertices";
  Json sets = is_one ? Json::array({given}) : given;
  for (Json& set : sets) {
    if (kind == "vertices" && !set.is_array()) set = Json::array({set});
    const std::size_t n = document.root->contains("pins") ? document.root["pins"].size() : 0;
    io::set_value(document, "pins." + std::to_string(n), Json{{kind, set}}, "`" + value.keyword + "`");
  }
}

void Call::apply_settings(unsigned subcommand, io::TomlDocument& document, Memory& memory) {
  if (frame.unit) io::set_value(document, "unit", *frame.unit, "`unit`");
  if (frame.up) io::set_value(document, "up", *frame.up, "`up`");
  make_lists(document);
  for (const io::Setting& s : io::scene_settings()) {
    if (!has_keyword(s, subcommand)) continue;
    for (const auto& [name, given] : given_) {
      if (name != s.keyword) continue;
      if (!used_.insert(name).second) continue;  // the job's own, as drape's subdivide
      if (s.table() == "pins")
        add_pins({name, given}, s.key(), document, memory);
      else
        io::set_value(document, s.path, to_json({name, given}, memory), s.name());
    }
  }
  for (const auto& [name, given] : given_) {
    if (name != "settings") continue;
    if (!py::isinstance<py::dict>(given)) Value{name, given}.fail("a dict of settings");
    used_.insert(name);
    set_all(to_json({name, given}, memory), "", "`settings`", document);
  }
  make_lists(document);
}

void Call::require_all_used(const std::vector<KeywordWords>& known) const {
  std::vector<std::string> names;
  for (const KeywordWords& k : known) names.push_back(k.name);
  for (const auto& [name, given] : given_)
    if (!used_.count(name))
      throw py::type_error("no keyword '" + name + "'; did you mean '" + io::nearest_word(name, names) +
                           "'?");
}

std::vector<KeywordWords> common_keywords() {
  jobs::Frame frame;
  PythonListener listener;
  const Keywords rows = keywords_of(jobs::common_card(frame, listener.force, listener.replace));
  std::vector<KeywordWords> words(rows.begin(), rows.end());
  words.push_back({"progress", "Progress", "called with (what, share in [0, 1]), at most every 50 ms"});
  words.push_back({"cancel", "Cancel", "asked about every 50 ms; True: the job ends"});
  return words;
}

std::vector<KeywordWords> setting_keywords(unsigned subcommand) {
  std::vector<KeywordWords> words;
  for (const io::Setting& s : io::scene_settings())
    if (has_keyword(s, subcommand))
      words.push_back({s.keyword, type_of(s), io::described(s, std::mem_fn(&io::Setting::keyword))});
  words.push_back({"settings", "Mapping[str, Any]", "any settings of a scene: {\"material.bending\": 1}"});
  return words;
}

CalledScene called_scene(py::handle garment, unsigned subcommand, const std::filesystem::path& state,
                         Call& call) {
  CalledScene scene;
  Memory memory(scene.input.memory);
  if (!state.empty()) {
    scene.state = io::read_state(state);
    scene.state_path = state;
    scene.input.folder = scene.state_path.parent_path();
  }
  scene.input.settings = document_of(garment, scene, memory);
  call.apply_settings(subcommand, scene.input.settings, memory);
  return scene;
}

std::string garment_name(const jobs::SceneInput& scene) {
  const Json garment = scene.settings.root->value("garment", Json::object());
  const std::string mesh = garment.is_object() && garment.contains("mesh") && garment["mesh"].is_string()
                               ? garment["mesh"].get<std::string>()
                               : "garment";
  return std::filesystem::path(mesh).stem().string();
}

void Call::apply(const Keywords& rows) {
  for (const auto& [name, given] : given_)
    for (const Keyword& row : rows)
      if (row.name == name) {
        used_.insert(name);
        row.set(Value{name, given});
      }
}

std::vector<KeywordWords> words_of(const Keywords& rows, unsigned subcommand) {
  std::vector<KeywordWords> words(rows.begin(), rows.end());
  for (auto& list :
       {subcommand ? setting_keywords(subcommand) : std::vector<KeywordWords>{}, common_keywords()})
    words.insert(words.end(), list.begin(), list.end());
  return words;
}

}  // namespace furrow::python
