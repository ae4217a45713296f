// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/follow.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "bridge/arrays/convert.h"
#include "bridge/draping/follow_body.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/vertex_attributes.h"
#include "io/base/figure_path.h"
#include "jobs/base/card.h"
#include "jobs/base/gate.h"
#include "jobs/base/output_checks.h"
#include "jobs/base/read_inputs.h"
#include "physics/base/cancel_scope.h"

namespace furrow::jobs {
namespace {

using physics::Vec3;
using Moves = std::vector<Vec3>;  // of vertices [m]

constexpr double moves_least = 1e-4;  // of a vertex that a key is said to move [m]
constexpr double kept_least = 1e-5;   // below it a move is left out, so that keys are sparse [m]

/// A shape of the body, and what the garment makes of it.
struct Shape {
  std::string name;
  Moves body, garment = {};
};

/// Of two shapes of the body, by their numbers, what is left to be pushed out.
struct Corrective {
  std::size_t a, b;
  Moves garment;
};

std::string key_name(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) <= ' ') c = '_';
  return name;
}

/// The body's keys that are asked for, and those of other files.
std::vector<Shape> shapes_of(const FollowJob& job, const io::MeshFile& body, const Context& context) {
  std::vector<Shape> shapes;
  const std::vector<std::string> own = geometry::shape_key_names(body.mesh);
  for (const std::string& key : job.keys)
    if (std::ranges::find(own, key_name(key)) == own.end())
      throw std::invalid_argument("keys: " + name_of(job.body, "the body") + " has no shape key '" + key +
                                  "'");
  const auto is_asked = [&](const std::string& name) {
    return job.keys.empty() ||
           std::ranges::any_of(job.keys, [&](const auto& key) { return key_name(key) == name; });
  };
  for (const std::string& name : own) {
    if (!is_asked(name)) continue;
    Shape& shape = shapes.emplace_back(Shape{name, {}});
    for (const geometry::Vector& move : geometry::shape_key(body.mesh, name))
      shape.body.emplace_back(move.x(), move.y(), move.z());
  }
  const Moves at = bridge::positions_of(body.mesh);
  for (const MeshInput& input : job.body_keys) {
    const io::MeshFile other = read_mesh(input, context);
    const std::string name = name_of(input, "a body of body_keys");
    if (bridge::triangles_of(other.mesh) != bridge::triangles_of(body.mesh))
      throw geometry::ContentError(name + ": has not the vertices and faces of " +
                                   name_of(job.body, "the body") + ", in their order");
    Shape& shape = shapes.emplace_back(Shape{key_name(io::stem_of(name)), bridge::positions_of(other.mesh)});
    for (std::size_t i = 0; i < at.size(); ++i) shape.body[i] -= at[i];
  }
  if (shapes.empty())
    throw geometry::ContentError(
        name_of(job.body, "the body") +
        ": has no shape keys to follow; name the body in other shapes with `body_keys`");
  return shapes;
}

void add(Moves& sum, const Moves& moves, double share) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += share * moves[i];
}

Moves scaled(const Moves& moves, double share) {
  Moves sum(moves.size(), Vec3::Zero());
  add(sum, moves, share);
  return sum;
}

void drop_small(Moves& moves) {
  for (Vec3& move : moves)
    if (move.norm() < kept_least) move.setZero();
}

FollowedKey described(const std::string& name, const Moves& moves) {
  FollowedKey key{name};
  for (const Vec3& move : moves) {
    key.vertices += move.norm() >= moves_least;
    key.farthest = std::max(key.farthest, move.norm());
  }
  return key;
}

/// Pairs that come through where neither does alone, pushed out.
std::vector<Corrective> correctives_for(const std::vector<Shape>& shapes,
                                        const bridge::BodyFollower& follower, double poke,
                                        FollowReport& report, const ProgressScope& progress,
                                        const Context& context) {
  std::vector<Corrective> correctives;
  for (std::size_t a = 0; a < shapes.size(); ++a)
    for (std::size_t b = a + 1; b < shapes.size(); ++b) {
      progress(0.3 + 0.4 * double(a) / double(shapes.size()));
      stop_if_cancelled(context);
      Moves body = shapes[a].body, garment = shapes[a].garment;
      add(body, shapes[b].body, 1), add(garment, shapes[b].garment, 1);
      if (follower.deepest(garment, body) <= poke) continue;
      Moves pushed = garment;
      follower.push_out(pushed, body);
      add(garment, pushed, -1);
      Corrective made{a, b, scaled(garment, -1)};
      drop_small(made.garment);
      FollowedKey& key =
          report.correctives.emplace_back(described(shapes[a].name + "*" + shapes[b].name, made.garment));
      key.poke_at_full = follower.deepest(pushed, body);
      correctives.push_back(std::move(made));
    }
  return correctives;
}

/// Each key anywhere from 0 to 1: how much deeper the garment lies in the body.
void try_mixes(const std::vector<Shape>& shapes, const std::vector<Corrective>& correctives,
               const bridge::BodyFollower& follower, int count, FollowReport& report,
               const ProgressScope& progress, const Context& context) {
  std::mt19937_64 random(20261201);
  const auto share = [&] { return double(random() >> 11) * 0x1p-53; };
  for (int i = 0; i < count; ++i) {
    progress(0.7 + 0.3 * i / count);
    stop_if_cancelled(context);
    std::vector<double> weights;
    Moves body(shapes[0].body.size(), Vec3::Zero()), garment(shapes[0].garment.size(), Vec3::Zero());
    for (const Shape& shape : shapes) {
      weights.push_back(share());
      add(body, shape.body, weights.back()), add(garment, shape.garment, weights.back());
    }
    for (const Corrective& c : correctives) add(garment, c.garment, weights[c.a] * weights[c.b]);
    report.mixes.push_back(follower.deepest(garment, body));
  }
  std::ranges::sort(report.mixes);
}

void set_key(geometry::Mesh& mesh, const std::string& name, const Moves& moves) {
  std::vector<geometry::Vector> vectors;
  for (const Vec3& m : moves) vectors.emplace_back(m.x(), m.y(), m.z());
  geometry::set_shape_key(mesh, name, vectors);
}

void check(const FollowJob& job, Listener& listener) {
  check_card(job);
  const std::string output = job.output.string();
  if (output.empty() || output == "-") return;
  check_output(output);
  if (const std::string ending = io::ending_of(output);
      ending != ".glb" && ending != ".vrm" && ending != ".ply")
    throw std::invalid_argument(output +
                                ": has no place for shape keys; let the name end in .glb, .vrm or .ply");
  std::vector<std::string> inputs{name_of(job.garment, ""), name_of(job.body, "")};
  for (const MeshInput& input : job.body_keys) inputs.push_back(name_of(input, ""));
  check_replaced({output}, inputs, listener);
}

}  // namespace

FollowReport follow(const FollowJob& job, Listener& listener) {
  const physics::CancelScope cancelling([&listener] { return listener.cancelled(); });
  check(job, listener);
  FollowReport report;
  report.frame = job.frame;
  take_noted_frame(report.frame, {name_of(job.garment, ""), name_of(job.body, "")});
  const Context context{report.frame, listener};
  report.garment = read_garment(job.garment, context);
  const io::MeshFile body = read_mesh(job.body, context);
  require_area(body.mesh, name_of(job.body, "body"));
  std::vector<Shape> shapes = shapes_of(job, body, context);
  const ProgressScope progress(listener, "following");
  geometry::Mesh& mesh = report.garment.mesh;
  const bridge::BodyFollower follower(
      mesh, {bridge::positions_of(body.mesh), bridge::triangles_of(body.mesh)}, {.gap = job.gap});
  for (Shape& shape : shapes) {
    progress(0.3 * double(report.keys.size()) / double(shapes.size()));
    stop_if_cancelled(context);
    shape.garment = follower.follow(shape.body);
    follower.push_out(shape.garment, shape.body);
    drop_small(shape.garment);
    FollowedKey& key = report.keys.emplace_back(described(shape.name, shape.garment));
    key.poke_at_full = follower.deepest(shape.garment, shape.body);
    key.poke_at_half = follower.deepest(scaled(shape.garment, 0.5), scaled(shape.body, 0.5));
    set_key(mesh, shape.name, shape.garment);
  }
  const std::vector<Corrective> correctives =
      correctives_for(shapes, follower, job.poke, report, progress, context);
  for (const Corrective& c : correctives) set_key(mesh, shapes[c.a].name + "*" + shapes[c.b].name, c.garment);
  try_mixes(shapes, correctives, follower, job.mixes, report, progress, context);
  if (!job.output.empty() && job.output != "-") write_mesh(job.output, report.garment, context);
  return report;
}

double FollowReport::mixes_at(double share) const {
  if (mixes.empty()) return 0;
  return mixes[std::min(mixes.size() - 1, std::size_t(share * double(mixes.size())))];
}

std::vector<CardRow> card(FollowJob& job) {
  return {
      {"body", &job.body, "body that the garment fits, with shape keys: a glb or vrm, or a ply of ours"},
      {"body_keys", &job.body_keys,
       "files of that body in other shapes, its vertices the same: keys by their names"},
      {"keys", Listed{&job.keys}, "the body's shape keys to follow (default: all)"},
      {"output", &job.output, "mesh with the keys to write: glb, vrm or ply"},
      {"gap", &job.gap, not_negative,
       "distance kept from the body in every shape, where the garment keeps it [m]"},
      {"poke", &job.poke, positive, "depth from which two keys together get a corrective key, A*B [m]"},
      {"mixes", &job.mixes, between(0, 10000), "random mixtures of keys to try at the end"},
  };
}

Json to_json(const FollowReport& r) {
  const auto rows = [](const std::vector<FollowedKey>& keys) {
    Json list = Json::array();
    for (const FollowedKey& k : keys)
      list.push_back({{"name", k.name},
                      {"vertices", k.vertices},
                      {"farthest", k.farthest},
                      {"poke_at_half", k.poke_at_half},
                      {"poke_at_full", k.poke_at_full}});
    return list;
  };
  return {{"vertices", r.garment.mesh->number_of_vertices()},
          {"keys", rows(r.keys)},
          {"correctives", rows(r.correctives)},
          {"mixes", r.mixes.size()},
          {"mixes_p50", r.mixes_at(0.5)},
          {"mixes_p99", r.mixes_at(0.99)},
          {"mixes_most", r.mixes_at(1)}};
}

}  // namespace furrow::jobs
