// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/arrays/store_rest_state.h"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <tuple>

#include "geometry/fold/line_press.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/press_map.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "physics/plate/plate_bending.h"

namespace furrow::bridge {
namespace {

using namespace geometry;
using physics::Spring;

[[noreturn]] void fail(const std::string& what) { throw std::invalid_argument("store_rest_state: " + what); }

std::string name_of(const char* kind, std::size_t i) { return std::string(kind) + " " + std::to_string(i); }

void check_value(const std::string& element, const char* what, double value, bool fine) {
  if (!fine || !std::isfinite(value))
    fail(element + ": " + what + " = " + std::to_string(value) + " is out of its range");
}

void check_spring(const std::string& element, const Spring& s) {
  check_value(element, "rest length", s.rest_length, s.rest_length > 0);
  check_value(element, "stiffness", s.stiffness, s.stiffness >= 0);
}

void check_count(const char* kind, std::size_t has, std::size_t wants) {
  if (has != wants)
    fail("the cloth has " + std::to_string(has) + " " + kind + " elements, the mesh " +
         std::to_string(wants));
}

void check_structural(const std::vector<Spring>& springs, const std::vector<Spring>& expected) {
  check_count("structural", springs.size(), expected.size());
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const std::string element = name_of("structural spring", i);
    if (std::tie(springs[i].a, springs[i].b) != std::tie(expected[i].a, expected[i].b))
      fail(element + " joins other vertices than in the mesh");
    check_spring(element, springs[i]);
  }
}

void check_tension(const std::vector<physics::Tension>& tension,
                   const std::vector<physics::Tension>& expected, double compression) {
  check_count("tension", tension.size(), expected.size());
  for (std::size_t i = 0; i < tension.size(); ++i) {
    const physics::Tension& t = tension[i];
    const std::string element = name_of("tension", i);
    if (std::tie(t.a, t.b) != std::tie(expected[i].a, expected[i].b))
      fail(element + " joins other vertices than in the mesh");
    check_value(element, "rest length", t.rest_length, t.rest_length > 0);
    check_value(element, "stretch", t.stretch, t.stretch >= 0);
    if (t.compress != compression * t.stretch)
      fail(element + " pushes otherwise than the material does; that cannot be stored");
  }
}

/// Of all kinds of triangles, one kind after the other.
struct Triangles {
  std::vector<std::size_t> counts;
  std::vector<physics::MembraneTriangle> all;
};

Triangles triangles_of(const physics::Cloth& cloth) {
  Triangles result;
  physics::for_each_kind(cloth, [&](const auto& kind, auto...) {
    using Element = typename std::remove_cvref_t<decltype(kind)>::value_type;
    if constexpr (std::derived_from<Element, physics::MembraneTriangle>) {
      result.counts.push_back(kind.size());
      result.all.insert(result.all.end(), kind.begin(), kind.end());
    }
  });
  return result;
}

void check_membrane(const Triangles& cloth, const Triangles& expected) {
  for (std::size_t k = 0; k < cloth.counts.size(); ++k)
    check_count("membrane", cloth.counts[k], expected.counts[k]);
  for (std::size_t i = 0; i < cloth.all.size(); ++i) {
    const physics::MembraneTriangle &t = cloth.all[i], &wanted = expected.all[i];
    const std::string element = name_of("membrane triangle", i);
    if (t.vertices != wanted.vertices) fail(element + " has other vertices than in the mesh");
    if (t.lambda != wanted.lambda || t.mu != wanted.mu || t.threads.warp != wanted.threads.warp ||
        t.threads.weft != wanted.threads.weft)
      fail(element + " has Lame parameters of its own; these are the material's and cannot be stored");
    const auto& [a, b, c] = t.rest_lengths;
    for (const double l : t.rest_lengths) check_value(element, "rest length", l, l > 0);
    if (!(triangle_area(a, b, c) > 0)) fail(element + ": its rest lengths span no area");
  }
}

void check_hinges(const std::vector<physics::Hinge>& hinges, const std::vector<physics::Hinge>& expected) {
  check_count("hinge", hinges.size(), expected.size());
  for (std::size_t i = 0; i < hinges.size(); ++i) {
    const std::string element = name_of("hinge", i);
    if (hinges[i].vertices != expected[i].vertices) fail(element + " has other vertices than in the mesh");
    check_value(element, "rest angle", hinges[i].rest_angle,
                std::abs(hinges[i].rest_angle) <= std::numbers::pi);
    check_value(element, "stiffness", hinges[i].stiffness, hinges[i].stiffness >= 0);
  }
}

/// The cloth's bending springs, parted.
struct BendingParts {
  std::vector<std::pair<Edge, Spring>> cross;
  std::vector<Strut> struts;
};

BendingParts part(std::vector<Spring> springs, const GatheredCloth& of_mesh) {
  std::stable_sort(springs.begin(), springs.end(),
                   [](const Spring& s, const Spring& t) { return std::tie(s.a, s.b) < std::tie(t.a, t.b); });
  const std::size_t vertices = of_mesh.cloth.particles.size();
  BendingParts result;
  std::size_t next = 0;  // of the mesh's, which are sorted in the same way
  const auto pass_struts = [&] {
    while (next < of_mesh.bending.size() && of_mesh.bending[next] == Mesh::null_edge()) ++next;
  };
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const Spring& s = springs[i];
    check_spring(name_of("bending spring", i), s);
    if (s.a < 0 || s.a >= s.b || static_cast<std::size_t>(s.b) >= vertices)
      fail(name_of("bending spring", i) + " joins no two vertices of the mesh, the lower one first");
    pass_struts();
    const bool is_cross = next < of_mesh.bending.size() && of_mesh.cloth.bending[next].a == s.a &&
                          of_mesh.cloth.bending[next].b == s.b;
    if (is_cross) {
      result.cross.emplace_back(of_mesh.bending[next++], s);
    } else {
      const auto vertex = [](int v) { return Vertex(static_cast<Vertex::size_type>(v)); };
      result.struts.push_back({vertex(s.a), vertex(s.b), s.rest_length, s.stiffness});
    }
  }
  pass_struts();
  if (next != of_mesh.bending.size()) fail("a bending spring of the mesh is missing");
  return result;
}

void write_springs(const std::vector<Spring>& springs, const std::vector<Edge>& origin, Mesh& mesh) {
  if (springs.empty()) return;
  auto rest = ensure_map(mesh, attribute::rest_length), stiffness = ensure_map(mesh, attribute::stiffness);
  for (std::size_t i = 0; i < springs.size(); ++i) {
    rest[origin[i]] = springs[i].rest_length;
    stiffness[origin[i]] = springs[i].stiffness;
  }
}

void write_tension(const std::vector<physics::Tension>& tension, const std::vector<Edge>& origin,
                   Mesh& mesh) {
  if (tension.empty()) return;
  auto rest = ensure_map(mesh, attribute::rest_length), stretch = ensure_map(mesh, attribute::tension);
  for (std::size_t i = 0; i < tension.size(); ++i) {
    rest[origin[i]] = tension[i].rest_length;
    stretch[origin[i]] = tension[i].stretch;
  }
}

void write_membrane(const std::vector<physics::MembraneTriangle>& triangles,
                    const std::vector<Halfedge>& origin, Mesh& mesh) {
  if (triangles.empty()) return;
  auto rest = ensure_map(mesh, attribute::triangle_rest_length);
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    int i = 0;
    for (Halfedge h : mesh.halfedges_around_face(origin[f]))
      rest[mesh.prev(h)] = triangles[f].rest_lengths[i++];  // of the edge opposite target(h)
  }
}

void write_bending(const BendingParts& bending, Mesh& mesh) {
  set_struts(mesh, bending.struts);
  if (bending.cross.empty()) return;
  auto rest = ensure_map(mesh, attribute::bending_rest_length),
       stiffness = ensure_map(mesh, attribute::bending_stiffness);
  for (const auto& [edge, spring] : bending.cross) {
    rest[edge] = spring.rest_length;
    stiffness[edge] = spring.stiffness;
  }
}

/// The cloth's hinges, those of its plates among them, in the mesh's order.
struct Hinges {
  std::vector<physics::Hinge> all;
  std::vector<char> coupled;
  std::vector<double> press;  ///< of each; 1 where it is not known
};

Hinges hinges_of(const physics::Cloth& cloth, const std::vector<physics::Hinge>& expected) {
  Hinges result{cloth.hinges, std::vector<char>(cloth.hinges.size(), 0), {}};
  result.press.resize(result.all.size(), 1);
  std::map<std::array<int, 4>, std::pair<physics::Hinge, double>> coupled;
  for (const auto& energy : cloth.energies)
    if (const auto* plate = dynamic_cast<const physics::PlateBending*>(energy.get()))
      for (std::size_t i = 0; i < plate->plate().hinges.size(); ++i) {
        const physics::Hinge& h = plate->plate().hinges[i];
        const auto& origin = plate->origin();
        coupled.emplace(h.vertices,
                        std::pair(h, origin ? origin->press[std::size_t(origin->coupled[i])] : 1));
      }
  if (coupled.empty()) return result;
  result = {};
  std::size_t next = 0;
  for (const physics::Hinge& wanted : expected) {
    const auto found = coupled.find(wanted.vertices);
    if (found == coupled.end() && next == cloth.hinges.size()) continue;
    result.coupled.push_back(found != coupled.end());
    result.press.push_back(found != coupled.end() ? found->second.second : 1);
    result.all.push_back(found != coupled.end() ? found->second.first : cloth.hinges[next++]);
  }
  check_count("plain hinge", next, cloth.hinges.size());
  return result;
}

void write_hinges(const Hinges& hinges, const std::vector<Edge>& origin, Mesh& mesh) {
  if (hinges.all.empty()) return;
  auto angle = ensure_map(mesh, attribute::rest_angle),
       stiffness = ensure_map(mesh, attribute::hinge_stiffness);
  for (std::size_t i = 0; i < hinges.all.size(); ++i) {
    angle[origin[i]] = hinges.all[i].rest_angle;
    if (!hinges.coupled[i]) stiffness[origin[i]] = hinges.all[i].stiffness;
  }
}

/// Presses of a plate's hinges, unless those of the lines are the same: these follow what is drawn later.
void write_presses(const Hinges& hinges, const std::vector<Edge>& origin, const GatherOptions& options,
                   Mesh& mesh) {
  if (options.bending != Bending::plate) return;
  const std::vector<double> by_lines = hinge_presses(mesh, options.line_presses, options.line_widths);
  bool same = !find_map(mesh, attribute::press);
  for (std::size_t i = 0; i < hinges.all.size(); ++i)
    same =
        same && (!hinges.coupled[i] || hinges.press[i] == (by_lines.empty() ? 1 : by_lines[origin[i].idx()]));
  if (same) return;
  auto press = ensure_map(mesh, attribute::press);
  for (std::size_t i = 0; i < hinges.all.size(); ++i)
    if (hinges.coupled[i]) press[origin[i]] = hinges.press[i];
}

}  // namespace

void store_rest_state(const physics::Cloth& cloth, const GatherOptions& options, Mesh& mesh) {
  const GatheredCloth of_mesh = gather_with_origin(mesh, options);
  check_structural(cloth.structural, of_mesh.cloth.structural);
  check_tension(cloth.tension, of_mesh.cloth.tension, options.compression);
  const Triangles triangles = triangles_of(cloth);
  check_membrane(triangles, triangles_of(of_mesh.cloth));
  const Hinges hinges = hinges_of(cloth, of_mesh.cloth.hinges);
  check_hinges(hinges.all, of_mesh.cloth.hinges);
  const BendingParts bending = part(cloth.bending, of_mesh);
  write_springs(cloth.structural, of_mesh.structural, mesh);
  write_tension(cloth.tension, of_mesh.tension, mesh);
  write_membrane(triangles.all, of_mesh.membrane, mesh);
  write_bending(bending, mesh);
  write_hinges(hinges, of_mesh.hinges, mesh);
  write_presses(hinges, of_mesh.hinges, options, mesh);
}

}  // namespace furrow::bridge
