// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/state_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <sstream>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/vertex_attributes.h"
#include "io/base/bytes_file.h"
#include "io/base/nesting.h"
#include "io/mesh/mesh_file.h"
#include "io/mesh/mesh_readers.h"
#include "io/mesh/mesh_writers.h"
#include "physics/motion/state_memory.h"

namespace furrow::io {
namespace {

using namespace geometry;
using physics::Integrator;
using physics::SimulateState;
using physics::Vec3;
using Json = nlohmann::ordered_json;

constexpr const char* prefix = "furrow state ";
bool is_state(const std::string& comment) { return comment.rfind(prefix, 0) == 0; }

/// JSON knows neither infinity nor NaN: null is infinity (a limit without springs, a fade that never ends).
Json number(double x) { return std::isinf(x) ? Json(nullptr) : Json(x); }
double number(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

Json to_json(const physics::EnergyBalance& e) {
  return {e.seconds, e.kinetic, e.elastic,         e.weight, e.by_air,
          e.by_body, e.by_pins, e.by_compensation, e.to_air, e.to_contact};
}

physics::EnergyBalance balance_of(const Json& j) {
  if (j.empty()) return {};
  const auto e = j.get<std::array<double, 10>>();
  return {e[0], e[1], e[2], e[3], e[4], e[5], e[6], e[7], e[8], e[9]};
}

Json to_json(const physics::LongestEdge& e) { return {e.strain, e.time, e.at.x(), e.at.y(), e.at.z()}; }

physics::LongestEdge longest_edge_of(const Json& j) {
  if (j.empty()) return {};
  const auto e = j.get<std::array<double, 5>>();
  return {e[0], e[1], {e[2], e[3], e[4]}};
}

/// Without the clock times: the same simulation gives the same bytes.
Json to_json(const physics::SimulateTotals& t) {
  return {{"force_evaluations", t.force_evaluations},
          {"spring_evaluations", t.spring_evaluations},
          {"triangle_evaluations", t.triangle_evaluations},
          {"hinge_evaluations", t.hinge_evaluations},
          {"linear_solves", t.linear_solves},
          {"factorisations", t.factorisations},
          {"iterations", t.iterations},
          {"open_steps", t.open_steps},
          {"energy", to_json(t.energy)},
          {"longest_edge", to_json(t.longest_edge)},
          {"collider_queries", t.collider_queries},
          {"truncated_moves", t.truncated_moves},
          {"cut_moves", t.cut_moves},
          {"limit_estimates", t.limit_estimates},
          {"frames_built", t.frames_built},
          {"dt_smallest", number(t.dt_smallest)},
          {"dt_limit_smallest", number(t.dt_limit_smallest)}};
}

physics::SimulateTotals totals_of(const Json& j) {
  physics::SimulateTotals t;
  t.force_evaluations = j.at("force_evaluations");
  t.spring_evaluations = j.value("spring_evaluations", std::int64_t{0});  // absent in older files
  t.triangle_evaluations = j.value("triangle_evaluations", std::int64_t{0});
  t.hinge_evaluations = j.value("hinge_evaluations", std::int64_t{0});
  t.linear_solves = j.value("linear_solves", std::int64_t{0});  // files of the first version have none
  t.factorisations = j.value("factorisations", std::int64_t{0});
  t.iterations = j.value("iterations", std::int64_t{0});
  t.open_steps = j.value("open_steps", std::int64_t{0});
  t.energy = balance_of(j.value("energy", Json::array()));
  t.longest_edge = longest_edge_of(j.value("longest_edge", Json::array()));
  t.collider_queries = j.at("collider_queries");
  t.truncated_moves = j.at("truncated_moves");
  t.cut_moves = j.value("cut_moves", std::int64_t{0});
  t.limit_estimates = j.at("limit_estimates");
  t.frames_built = j.at("frames_built");
  t.dt_smallest = number(j.at("dt_smallest"));
  t.dt_limit_smallest = number(j.at("dt_limit_smallest"));
  return t;
}

Json to_json(const physics::SelfContactMemory& self) {
  Json json{{"stiffness", self.stiffness},
            {"crossed_at_start", self.crossed_at_start},
            {"loose", self.loose},
            {"coupled", self.coupled},
            {"pairs", Json::array()},
            {"friction", Json::array()},
            {"ordered_for", self.ordered_for}};
  for (const physics::PairMemory& p : self.pairs)
    json["pairs"].push_back({int(p.edges), p.vertices, p.range, p.target});
  for (const physics::PairFrictionMemory& f : self.friction)
    json["friction"].push_back(
        {int(f.edges), f.vertices, f.tether.x(), f.tether.y(), f.tether.z(), int(f.slides)});
  return json;
}

physics::SelfContactMemory self_contact_of(const Json& json) {
  physics::SelfContactMemory self;
  self.stiffness = json.at("stiffness");
  self.crossed_at_start = json.at("crossed_at_start");
  self.loose = json.at("loose").get<std::vector<int>>();
  self.coupled = json.at("coupled").get<std::vector<std::array<int, 2>>>();
  for (const Json& p : json.at("pairs"))
    self.pairs.push_back({p.at(0).get<int>() != 0, p.at(1), p.at(2), p.at(3)});
  self.ordered_for = json.at("ordered_for").get<std::vector<std::array<int, 2>>>();
  for (const Json& f : json.at("friction"))
    self.friction.push_back(
        {f.at(0).get<int>() != 0, f.at(1), Vec3(f.at(2), f.at(3), f.at(4)), f.at(5).get<int>() != 0});
  return self;
}

Json to_json(const SavedState& saved) {
  const SimulateState& s = saved.simulation;
  Json json{{"version", 3},
            {"time", s.time},
            {"step", s.step},
            {"planned", s.planned},
            {"end", s.end},
            {"dt", s.dt},
            {"dt_longest", number(s.dt_longest)},
            {"steps_left", s.steps_left},
            {"estimated_at", s.estimated_at},
            {"dt_limit", number(s.dt_limit)},
            {"strain_at_estimate", s.strain_at_estimate},
            {"cloth", s.cloth},
            {"body", saved.body},
            {"body_travel", s.body_travel},
            {"homes", Json::array()},
            {"force_jump_start", s.compensation.start},
            {"force_jump_fade", number(s.compensation.time_constant)},
            {"totals", to_json(s.totals)},
            {"pins", saved.pins},
            {"lines_drawn", saved.lines_drawn},
            {"contact_gap", saved.contact_gap},
            {"scene", saved.scene}};
  if (saved.integrator)
    json["integrator"] = *saved.integrator == Integrator::implicit ? "implicit" : "leapfrog";
  if (saved.field_tolerance > 0) json["field_tolerance"] = saved.field_tolerance;
  if (s.steps.contact_stiffness > 0) json["contact_stiffness"] = s.steps.contact_stiffness;
  if (s.steps.self.stiffness > 0) json["self_contact"] = to_json(s.steps.self);
  if (!s.steps.fresh.empty()) json["fresh"] = s.steps.fresh;
  for (const Vec3& home : s.homes)
    for (int k = 0; k < 3; ++k) json["homes"].push_back(home[k]);
  return json;
}

/// Lists of indices of the mesh's vertices.
std::vector<std::vector<int>> pins_of(const Json& json, std::size_t vertices) {
  std::vector<std::vector<int>> pins;
  for (const Json& list : json) {
    pins.emplace_back();
    for (const Json& index : list) {
      const double i = index.get<double>();
      if (!(i >= 0 && i < double(vertices)))
        throw std::invalid_argument("pin " + index.dump() + " is no vertex");
      pins.back().push_back(static_cast<int>(i));
    }
  }
  return pins;
}

/// Version 1 is of the time when lines that named no rule were drawn by "safe".
void name_rule(nlohmann::ordered_json& scene) {
  if (!scene.contains("lines")) return;
  auto& lines = scene["lines"];
  if (lines.is_object() && !lines.contains("rule")) lines["rule"] = "safe";
  if (!lines.is_array()) return;
  for (auto& round : lines)
    if (round.is_object() && !round.contains("rule")) round["rule"] = "safe";
}

SavedState from_json(const Json& json, std::size_t vertices) {
  const int version = json.value("version", 0);
  if (version < 1 || version > 3) throw std::invalid_argument("its version is not 1, 2 or 3");
  SavedState saved;
  SimulateState& s = saved.simulation;
  s.time = json.at("time");
  s.step = json.at("step");
  s.planned = json.at("planned");
  s.end = json.at("end");
  s.dt = json.at("dt");
  s.dt_longest = number(json.at("dt_longest"));
  s.steps_left = json.at("steps_left");
  s.estimated_at = json.at("estimated_at");
  s.dt_limit = number(json.at("dt_limit"));
  s.strain_at_estimate = json.at("strain_at_estimate");
  s.cloth = json.at("cloth");
  saved.body = json.at("body");
  s.body_travel = json.at("body_travel");
  const std::vector<double> homes = json.at("homes");
  if (homes.size() % 3 != 0) throw std::invalid_argument("a home of a pin is cut short");
  for (std::size_t i = 0; i + 2 < homes.size(); i += 3)
    s.homes.emplace_back(homes[i], homes[i + 1], homes[i + 2]);
  s.compensation.start = json.at("force_jump_start");
  s.compensation.time_constant = number(json.at("force_jump_fade"));
  s.totals = totals_of(json.at("totals"));
  saved.pins = pins_of(json.at("pins"), vertices);
  saved.lines_drawn = json.at("lines_drawn");
  if (saved.lines_drawn < 0) throw std::invalid_argument("lines_drawn is below 0");
  saved.contact_gap = json.value("contact_gap", 0.0);  // absent in older files
  if (!(saved.contact_gap >= 0 && saved.contact_gap < 1))
    throw std::invalid_argument("contact_gap is not in [0, 1) m");
  saved.field_tolerance = json.value("field_tolerance", 0.0);
  if (!(saved.field_tolerance >= 0 && saved.field_tolerance < 1))
    throw std::invalid_argument("field_tolerance is not in [0, 1) m");
  if (const std::string name = json.value("integrator", ""); !name.empty()) {
    if (name != "implicit" && name != "leapfrog")
      throw std::invalid_argument("integrator is neither implicit nor leapfrog");
    saved.integrator = name == "implicit" ? Integrator::implicit : Integrator::leapfrog;
  }
  s.steps.contact_stiffness = json.value("contact_stiffness", 0.0);
  // Older ones number layers that touch by how a cloth was laid out: it looks for them anew.
  if (json.contains("self_contact") && version > 2) s.steps.self = self_contact_of(json.at("self_contact"));
  s.steps.fresh = json.value("fresh", std::vector<int>{});
  saved.scene = json.at("scene");
  if (!saved.scene.is_object()) throw std::invalid_argument("its scene is no table");
  if (version == 1) name_rule(saved.scene);
  saved.scene.erase("output");  // a state has none: a stranger's would write where nobody said
  return saved;
}

Vector to_cgal(const Vec3& x) { return {x.x(), x.y(), x.z()}; }
Vec3 to_eigen(const Vector& x) { return {x.x(), x.y(), x.z()}; }

/// Columns of what implicit steps remember: numbers at vertices, under names of their own.
constexpr std::array anchor_names{"step_anchor_x", "step_anchor_y", "step_anchor_z",       "step_plane_x",
                                  "step_plane_y",  "step_plane_z",  "step_friction_limit", "step_slides"};
constexpr std::array nearer_names{"step_nearer"};
constexpr std::array acceleration_names{"step_acceleration_x", "step_acceleration_y", "step_acceleration_z"};

template <std::size_t n, class Value>
void fill_columns(Mesh& mesh, const std::array<const char*, n>& names, const Value& value) {
  for (std::size_t k = 0; k < n; ++k) {
    auto column = ensure_vertex_attribute(mesh, names[k]);
    for (Vertex v : mesh.vertices()) column[v] = value(std::size_t(v), k);
  }
}

/// Takes the columns out of the mesh; give(vertex, k) is asked where to put a number. false: they are not
/// there.
template <std::size_t n, class Give>
bool take_columns(Mesh& mesh, const std::array<const char*, n>& names, const Give& give) {
  std::array<std::optional<VertexMap<double>>, n> columns;
  for (const VertexAttribute& a : vertex_attributes(mesh))
    for (std::size_t k = 0; k < n; ++k)
      if (a.name == names[k]) columns[k] = a.values;
  if (!std::ranges::all_of(columns, [](const auto& column) { return column.has_value(); })) return false;
  for (std::size_t k = 0; k < n; ++k) {
    for (Vertex v : mesh.vertices()) give(std::size_t(v), k) = (*columns[k])[v];
    mesh.remove_property_map(*columns[k]);
  }
  return true;
}

void fill_steps(Mesh& mesh, const physics::StepMemory& steps) {
  if (!steps.anchors.empty()) {
    fill_columns(mesh, anchor_names, [&](std::size_t v, std::size_t k) {
      const physics::ContactAnchor& a = steps.anchors[v];
      if (k < 6) return k < 3 ? a.anchor[int(k)] : a.plane[int(k) - 3];
      return k == 6 ? a.limit : double(a.slides);
    });
    if (std::ranges::any_of(steps.anchors, [](const auto& a) { return a.nearer > 0; }))
      fill_columns(mesh, nearer_names, [&](std::size_t v, std::size_t) { return steps.anchors[v].nearer; });
  }
  if (!steps.acceleration.empty())
    fill_columns(mesh, acceleration_names,
                 [&](std::size_t v, std::size_t k) { return steps.acceleration[v][int(k)]; });
}

void take_steps(Mesh& mesh, physics::StepMemory& steps) {
  const std::size_t n = mesh.number_of_vertices();
  std::vector<std::array<double, 8>> anchors(n);
  std::vector<Vec3> acceleration(n);
  if (take_columns(mesh, anchor_names,
                   [&](std::size_t v, std::size_t k) -> double& { return anchors[v][k]; }))
    for (const auto& a : anchors)
      steps.anchors.push_back({{a[0], a[1], a[2]}, {a[3], a[4], a[5]}, a[6], a[7] != 0});
  std::vector<double> nearer(n);
  if (take_columns(mesh, nearer_names, [&](std::size_t v, std::size_t) -> double& { return nearer[v]; }))
    for (std::size_t v = 0; v < steps.anchors.size(); ++v) steps.anchors[v].nearer = nearer[v];
  const auto place = [&](std::size_t v, std::size_t k) -> double& { return acceleration[v][int(k)]; };
  if (take_columns(mesh, acceleration_names, place)) steps.acceleration = std::move(acceleration);
}

/// Contact memory and compensating forces into the mesh's maps; velocities are there.
void fill_maps(SavedState& state) {
  Mesh& mesh = state.file.mesh;
  const SimulateState& s = state.simulation;
  const auto check = [&](std::size_t n, const char* what) {
    if (n != 0 && n != mesh.number_of_vertices())
      throw std::invalid_argument(std::string("a state with ") + std::to_string(n) + " " + what + " for " +
                                  std::to_string(mesh.number_of_vertices()) + " vertices");
  };
  physics::for_each_particle_array(
      s, [&](const char* what, const auto& array, physics::Carried) { check(array.size(), what); });
  fill_steps(mesh, s.steps);
  ensure_map(mesh, attribute::velocity);
  if (!s.contact.empty()) {
    auto point = ensure_map(mesh, attribute::contact_point);
    auto level = ensure_map(mesh, attribute::contact_level);
    for (Vertex v : mesh.vertices()) {
      point[v] = to_cgal(s.contact[v].x);
      level[v] = s.contact[v].level;
    }
  }
  if (s.compensation.force.empty()) return;
  auto force = ensure_map(mesh, attribute::force_jump);
  for (Vertex v : mesh.vertices()) force[v] = to_cgal(s.compensation.force[v]);
}

void take_maps(SavedState& state) {
  Mesh& mesh = state.file.mesh;
  SimulateState& s = state.simulation;
  take_steps(mesh, s.steps);
  const auto point = find_map(mesh, attribute::contact_point);
  const auto level = find_map(mesh, attribute::contact_level);
  if (point && level)
    for (Vertex v : mesh.vertices()) s.contact.push_back({to_eigen((*point)[v]), (*level)[v]});
  if (const auto force = find_map(mesh, attribute::force_jump))
    for (Vertex v : mesh.vertices()) s.compensation.force.push_back(to_eigen((*force)[v]));
}

template <class Name>
void drop(Mesh& mesh, const Name& name) {
  if (auto map = find_map(mesh, name)) mesh.remove_property_map(*map);
}

}  // namespace

void drop_motion(MeshFile& file) {
  Mesh& mesh = file.mesh;
  std::erase_if(file.comments, is_state);
  drop(mesh, attribute::velocity);
  drop(mesh, attribute::force_jump);
  drop(mesh, attribute::contact_point);
  drop(mesh, attribute::contact_level);
  physics::StepMemory forgotten;
  take_steps(mesh, forgotten);
}

std::string state_bytes(SavedState state) {
  Mesh& mesh = state.file.mesh;
  check_mesh(mesh, "state");
  drop(mesh, attribute::force_jump);
  drop(mesh, attribute::contact_point);
  drop(mesh, attribute::contact_level);
  fill_maps(state);
  std::erase_if(state.file.comments, is_state);
  using Handler = Json::error_handler_t;
  state.file.comments.push_back(prefix + to_json(state).dump(-1, ' ', true, Handler::replace));
  std::ostringstream out;
  write_ply(out, state.file, {});
  return std::move(out).str();
}

void write_state(const std::filesystem::path& path, SavedState state) {
  const std::string bytes = state_bytes(std::move(state));
  write_bytes(path, std::as_bytes(std::span(bytes)));
}

SavedState parse_state(const std::string& bytes, const std::string& name) {
  ReadOptions options;
  options.chains = true;
  MeshFile file = read_ply(bytes, name, options);
  const auto comment = std::find_if(file.comments.begin(), file.comments.end(), is_state);
  if (comment == file.comments.end() || !find_map(file.mesh, attribute::velocity))
    throw ContentError(name + ": is no saved state; furrow simulate --save-state writes one");
  if (file.repairs.any())
    throw ContentError(name + ": the mesh of the saved state is damaged; write the state again");
  const auto refuse = [&](const std::string& what) {
    throw ContentError(name + ": the saved state is damaged (" + what + "); write it again");
  };
  if (!find_wrinkle_record(file)) refuse("the comment 'furrow wrinkle' is missing");
  SavedState state;
  try {
    const std::size_t vertices = file.mesh.number_of_vertices();
    const std::string text = comment->substr(std::string(prefix).size());
    if (is_nested_too_deep(text)) refuse("it is " + too_deep_text());
    state = from_json(Json::parse(text), vertices);
    file.comments.erase(comment);
    state.file = std::move(file);
    take_maps(state);
    check_mesh(state.file.mesh, name.c_str());
    physics::check(state.simulation, vertices);
  } catch (const nlohmann::json::exception& e) {
    refuse(e.what());
  } catch (const std::invalid_argument& e) {
    refuse(e.what());
  }
  return state;
}

SavedState read_state(const std::filesystem::path& path) {
  return parse_state(read_text(path), path.string());
}

}  // namespace furrow::io
