// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/state_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
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

// How a value stands in JSON: put() and get() of each type that is no number, text or list of such.

template <class T>
void put(Json& json, const T& value) {
  json = value;
}
template <class T>
void get(const Json& json, T& value) {
  value = json.get<T>();
}

void put(Json& json, const std::vector<Vec3>& points) {
  json = Json::array();
  for (const Vec3& p : points)
    for (int k = 0; k < 3; ++k) json.push_back(p[k]);
}
void get(const Json& json, std::vector<Vec3>& points) {
  const auto x = json.get<std::vector<double>>();
  if (x.size() % 3 != 0) throw std::invalid_argument("a home of a pin is cut short");
  for (std::size_t i = 0; i < x.size(); i += 3) points.emplace_back(x[i], x[i + 1], x[i + 2]);
}

void put(Json& json, const physics::EnergyBalance& e) {
  json = {e.seconds, e.kinetic, e.elastic,         e.weight, e.by_air,
          e.by_body, e.by_pins, e.by_compensation, e.to_air, e.to_contact};
}
void get(const Json& json, physics::EnergyBalance& balance) {
  const auto e = json.get<std::array<double, 10>>();
  balance = {e[0], e[1], e[2], e[3], e[4], e[5], e[6], e[7], e[8], e[9]};
}

void put(Json& json, const physics::LongestEdge& e) {
  json = {e.strain, e.time, e.at.x(), e.at.y(), e.at.z()};
}
void get(const Json& json, physics::LongestEdge& edge) {
  const auto e = json.get<std::array<double, 5>>();
  edge = {e[0], e[1], {e[2], e[3], e[4]}};
}

void put(Json& json, const std::vector<physics::PairMemory>& pairs) {
  json = Json::array();
  for (const auto& p : pairs) json.push_back({int(p.edges), p.vertices, p.range, p.target});
}
void get(const Json& json, std::vector<physics::PairMemory>& pairs) {
  for (const Json& p : json) pairs.push_back({p.at(0).get<int>() != 0, p.at(1), p.at(2), p.at(3)});
}

void put(Json& json, const std::vector<physics::PairFrictionMemory>& friction) {
  json = Json::array();
  for (const auto& f : friction)
    json.push_back({int(f.edges), f.vertices, f.tether.x(), f.tether.y(), f.tether.z(), int(f.slides)});
}
void get(const Json& json, std::vector<physics::PairFrictionMemory>& friction) {
  for (const Json& f : json)
    friction.push_back(
        {f.at(0).get<int>() != 0, f.at(1), Vec3(f.at(2), f.at(3), f.at(4)), f.at(5).get<int>() != 0});
}

void put(Json& json, const std::optional<Integrator>& integrator) {
  json = integrator == Integrator::implicit ? "implicit" : "leapfrog";
}
void get(const Json& json, std::optional<Integrator>& integrator) {
  if (json != "implicit" && json != "leapfrog")
    throw std::invalid_argument("integrator is neither implicit nor leapfrog");
  integrator = json == "implicit" ? Integrator::implicit : Integrator::leapfrog;
}

void put(Json& json, const physics::SimulateTotals& totals);
void get(const Json& json, physics::SimulateTotals& totals);
void put(Json& json, const physics::SelfContactMemory& self);
void get(const Json& json, physics::SelfContactMemory& self);

/// Puts the fields of a list into JSON.
struct FieldWriter {
  Json& json;
  template <class T>
  void operator()(const char* key, const T& value) const {
    put(json[key], value);
  }
  /// A field that stands there only where it says something.
  template <class T>
  void operator()(const char* key, const T& value, bool is_set) const {
    if (is_set) put(json[key], value);
  }
  /// A number that may be infinite (a limit without springs, a fade that never ends): null in JSON.
  void limit(const char* key, double value) const { json[key] = std::isinf(value) ? Json() : Json(value); }
};

/// Gets the same fields from JSON.
struct FieldReader {
  const Json& json;
  template <class T>
  void operator()(const char* key, T& value) const {
    get(json.at(key), value);
  }
  template <class T>
  void operator()(const char* key, T& value, bool) const {
    if (json.contains(key)) get(json.at(key), value);
  }
  void limit(const char* key, double& value) const {
    const Json& found = json.at(key);
    value = found.is_null() ? std::numeric_limits<double>::infinity() : found.get<double>();
  }
};

/// Without the clock times: the same simulation gives the same bytes.
template <class Fields, class Totals>
void list_fields(const Fields& field, Totals& t) {
  field("force_evaluations", t.force_evaluations);
  field("spring_evaluations", t.spring_evaluations);
  field("triangle_evaluations", t.triangle_evaluations);
  field("hinge_evaluations", t.hinge_evaluations);
  field("linear_solves", t.linear_solves);
  field("factorisations", t.factorisations);
  field("iterations", t.iterations);
  field("open_steps", t.open_steps);
  field("energy", t.energy);
  field("longest_edge", t.longest_edge);
  field("collider_queries", t.collider_queries);
  field("truncated_moves", t.truncated_moves);
  field("cut_moves", t.cut_moves);
  field("limit_estimates", t.limit_estimates);
  field("frames_built", t.frames_built);
  field.limit("dt_smallest", t.dt_smallest);
  field.limit("dt_limit_smallest", t.dt_limit_smallest);
}
void put(Json& json, const physics::SimulateTotals& totals) { list_fields(FieldWriter{json}, totals); }
void get(const Json& json, physics::SimulateTotals& totals) { list_fields(FieldReader{json}, totals); }

template <class Fields, class Self>
void list_self_contact(const Fields& field, Self& self) {
  field("stiffness", self.stiffness);
  field("crossed_at_start", self.crossed_at_start);
  field("loose", self.loose);
  field("coupled", self.coupled);
  field("pairs", self.pairs);
  field("friction", self.friction);
  field("ordered_for", self.ordered_for);
}
void put(Json& json, const physics::SelfContactMemory& self) { list_self_contact(FieldWriter{json}, self); }
void get(const Json& json, physics::SelfContactMemory& self) { list_self_contact(FieldReader{json}, self); }

template <class Fields, class State>
void list_state(const Fields& field, State& saved) {
  auto& s = saved.simulation;
  field("time", s.time);
  field("step", s.step);
  field("planned", s.planned);
  field("end", s.end);
  field("dt", s.dt);
  field.limit("dt_longest", s.dt_longest);
  field("steps_left", s.steps_left);
  field("estimated_at", s.estimated_at);
  field.limit("dt_limit", s.dt_limit);
  field("strain_at_estimate", s.strain_at_estimate);
  field("cloth", s.cloth);
  field("body", saved.body);
  field("body_travel", s.body_travel);
  field("homes", s.homes);
  field("force_jump_start", s.compensation.start);
  field.limit("force_jump_fade", s.compensation.time_constant);
  field("totals", s.totals);
  field("pins", saved.pins);
  field("lines_drawn", saved.lines_drawn);
  field("contact_gap", saved.contact_gap);
  field("scene", *saved.scene);
  field("integrator", saved.integrator, saved.integrator.has_value());
  field("field_tolerance", saved.field_tolerance, saved.field_tolerance > 0);
  field("contact_stiffness", s.steps.contact_stiffness, s.steps.contact_stiffness > 0);
  field("self_contact", s.steps.self, s.steps.self.stiffness > 0);
  field("fresh", s.steps.fresh, !s.steps.fresh.empty());
}

constexpr int version = 3;

Json to_json(const SavedState& saved) {
  Json json{{"version", version}};
  list_state(FieldWriter{json}, saved);
  return json;
}

SavedState from_json(const Json& json, std::size_t vertices) {
  if (json.value("version", 0) != version)
    throw std::invalid_argument("its version is not " + std::to_string(version));
  SavedState saved;
  list_state(FieldReader{json}, saved);
  for (const auto& pin : saved.pins)
    for (const int i : pin)
      if (i < 0 || std::size_t(i) >= vertices)
        throw std::invalid_argument("pin " + std::to_string(i) + " is no vertex");
  if (saved.lines_drawn < 0) throw std::invalid_argument("lines_drawn is below 0");
  if (!(saved.contact_gap >= 0 && saved.contact_gap < 1))
    throw std::invalid_argument("contact_gap is not in [0, 1) m");
  if (!(saved.field_tolerance >= 0 && saved.field_tolerance < 1))
    throw std::invalid_argument("field_tolerance is not in [0, 1) m");
  if (!saved.scene->is_object()) throw std::invalid_argument("its scene is no table");
  saved.scene->erase("output");  // a state has none: a stranger's would write where nobody said
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
    throw ContentError(name + ": is no saved state; `furrow simulate save_state` writes one");
  if (file.repairs.any())
    throw ContentError(name + ": the mesh of the saved state is damaged; write the state again");
  const auto refuse = [&](const std::string& what) {
    throw ContentError(name + ": the saved state is damaged (" + what + "); write it again");
  };
  if (!find_wrinkle_record(file)) refuse("the comment 'furrow wrinkle' is missing");
  SavedState state;
  try {
    const std::size_t vertices = file.mesh->number_of_vertices();
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
