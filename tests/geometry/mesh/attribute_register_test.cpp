// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "geometry/insert/mesh_editor.h"
#include "geometry/refine/subdivide.h"
#include "tests/geometry/mesh/filled_attributes.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

template <class K>
std::string element_of() {
  if constexpr (std::is_same_v<K, Vertex>)
    return "vertex";
  else if constexpr (std::is_same_v<K, Edge>)
    return "edge";
  else
    return "face";
}

template <class K>
bool fits(CarryRule rule) {
  switch (rule) {
    case CarryRule::blend:
      return std::is_same_v<K, Vertex> || std::is_same_v<K, Halfedge>;
    case CarryRule::copy:
      return std::is_same_v<K, Face>;
    case CarryRule::halves:
      return std::is_same_v<K, Edge>;
    default:
      return true;
  }
}

Vector sum_of(const std::vector<std::pair<double, Vector>>& terms) {
  Vector sum(0, 0, 0);
  for (const auto& [weight, value] : terms) sum += weight * value;
  return sum;
}
template <class Value>
Value sum_of(const std::vector<std::pair<double, Value>>& terms) {
  Value sum{};
  for (const auto& [weight, value] : terms)
    if constexpr (std::is_arithmetic_v<Value>)
      sum += static_cast<Value>(weight * value);
    else
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * value[k];
  return sum;
}

bool near(double a, double b) { return std::abs(a - b) < 1e-14; }
bool near(int a, int b) { return a == b; }
bool near(bool a, bool b) { return a == b; }
bool near(const Vector& a, const Vector& b) { return (a - b).squared_length() < 1e-28; }
template <std::size_t n>
bool near(const std::array<double, n>& a, const std::array<double, n>& b) {
  for (std::size_t k = 0; k < n; ++k)
    if (!near(a[k], b[k])) return false;
  return true;
}

/// What an edit of MeshEditor's did, told by the test and not by the editor.
struct Edit {
  std::function<void(MeshEditor&)> run;
  std::vector<std::pair<double, Vertex>> origin;          ///< of the new vertex, if there is one
  std::vector<Face> whole;                                ///< what the parts of a face come from
  std::optional<std::pair<Vertex, Vertex>> cut, flipped;  ///< an edge by its ends
};

Edge edge_of(const Mesh& mesh, Vertex a, Vertex b) { return mesh.edge(mesh.halfedge(a, b)); }

/// A mesh before and after an edit.
struct Edited {
  Mesh before, after;
  std::set<Edge> halves, turned, sides;  ///< of the mesh after: sides of changed faces
  std::set<Face> changed;
  std::optional<Edge> cut;  ///< of the mesh before
};

Edited edited(const Edit& edit) {
  Edited e;
  e.before = jittered(4, 4, 0.2, 3);
  fill_attributes(e.before);
  e.after = e.before;
  {
    MeshEditor editor(e.after);
    edit.run(editor);
    e.changed = editor.changed();
  }
  for (Face f : e.changed)
    for (Halfedge h : halfedges_of(e.after, f)) e.sides.insert(e.after.edge(h));
  if (edit.cut) {
    const Vertex middle(static_cast<Vertex::size_type>(e.before.number_of_vertices()));
    e.cut = edge_of(e.before, edit.cut->first, edit.cut->second);
    e.halves = {edge_of(e.after, edit.cut->first, middle), edge_of(e.after, edit.cut->second, middle)};
  }
  if (edit.flipped) e.turned.insert(edge_of(e.before, edit.flipped->first, edit.flipped->second));
  return e;
}

template <class V>
V expected(const Attribute<Vertex, V>& a, const VertexMap<V>& before, const Edited& e, const Edit& edit,
           Vertex v) {
  if (v.idx() < e.before.number_of_vertices()) return before[v];
  if (a.carry.insertion != CarryRule::blend) return a.default_value;
  std::vector<std::pair<double, V>> terms;
  for (const auto& [weight, from] : edit.origin) terms.emplace_back(weight, before[from]);
  return sum_of(terms);
}
template <class V>
V expected(const Attribute<Edge, V>& a, const EdgeMap<V>& before, const Edited& e, const Edit&, Edge edge) {
  const bool is_new = edge.idx() >= e.before.number_of_edges();
  if (a.carry.insertion == CarryRule::halves && e.halves.count(edge)) return before[*e.cut];
  if (is_new || e.halves.count(edge) || e.turned.count(edge)) return a.default_value;
  if (a.carry.insertion == CarryRule::unset && e.sides.count(edge)) return a.default_value;
  return before[edge];
}
template <class V>
V expected(const Attribute<Halfedge, V>& a, const HalfedgeMap<V>& before, const Edited& e, const Edit&,
           Halfedge h) {
  const bool changed = !e.after.is_border(h) && e.changed.count(e.after.face(h)) > 0;
  return changed || e.after.is_border(h) ? a.default_value : before[h];
}
template <class V>
V expected(const Attribute<Face, V>& a, const FaceMap<V>& before, const Edited& e, const Edit& edit, Face f) {
  if (f.idx() < e.before.number_of_faces()) return before[f];
  if (a.carry.insertion != CarryRule::copy) return a.default_value;
  // A new part has three corners, the new vertex among them; the other two are those of one old face.
  for (Face whole : edit.whole) {
    int shared = 0;
    for (Vertex v : corners_of(e.after, f))
      for (Vertex w : corners_of(e.before, whole)) shared += v == w;
    if (shared == 2) return before[whole];
  }
  FAIL("face " << f << " comes from nowhere");
  return a.default_value;
}

void check_insertion(const Edit& edit) {
  const Edited e = edited(edit);
  REQUIRE(e.changed.size() >= 2);
  std::size_t checked = 0;
  for_each_attribute([&]<class K, class V>(const Attribute<K, V>& a) {
    if (a.carry.insertion == CarryRule::computed) return;
    INFO(a.name);
    const auto before = *find_map(e.before, a), after = *find_map(e.after, a);
    std::size_t wrong = 0;
    for (const K key : keys_of<K>(e.after))
      wrong += !near(after[key], expected(a, before, e, edit, key)) &&
               !same(after[key], expected(a, before, e, edit, key));
    CHECK(wrong == 0);
    ++checked;
  });
  CHECK(checked >= 18);
}

using Subdivide = std::function<void(Mesh&)>;

/// Where a vertex of the mesh after one step of a subdivision comes from, with weights.
std::vector<std::pair<double, Vertex>> origin_of(const Mesh& before, bool cuts_edges, Vertex v) {
  if (v.idx() < before.number_of_vertices()) return {{1, v}};
  const auto i = static_cast<Mesh::size_type>(v.idx() - before.number_of_vertices());
  if (cuts_edges) return {{0.5, before.vertex(Edge(i), 0)}, {0.5, before.vertex(Edge(i), 1)}};
  std::vector<std::pair<double, Vertex>> corners;
  for (Vertex corner : corners_of(before, Face(i))) corners.emplace_back(1. / 3, corner);
  return corners;
}

/// The value of a corner in a face of the mesh before.
template <class V>
V corner_value(const Mesh& before, const HalfedgeMap<V>& map, Face face, Vertex corner) {
  for (Halfedge h : halfedges_of(before, face))
    if (before.target(h) == corner) return map[h];
  FAIL("no such corner");
  return {};
}

struct Step {
  const Mesh &before, &after;
  bool cuts_edges;
  Face parent(Face f) const {  // materials are numbered by face
    return Face(static_cast<Mesh::size_type>((*find_map(after, attribute::material))[f] - 1));
  }
  std::set<Edge> halves_of(Edge e) const {
    const Vertex middle(static_cast<Mesh::size_type>(before.number_of_vertices() + e.idx()));
    return {edge_of(after, before.vertex(e, 0), middle), edge_of(after, before.vertex(e, 1), middle)};
  }
};

template <class V>
std::size_t wrong_after(const Step& s, const Attribute<Vertex, V>& a) {
  const auto before = *find_map(s.before, a), after = *find_map(s.after, a);
  std::size_t wrong = 0;
  for (Vertex v : s.after.vertices()) {
    const bool is_new = v.idx() >= s.before.number_of_vertices();
    std::vector<std::pair<double, V>> terms;
    for (const auto& [weight, from] : origin_of(s.before, s.cuts_edges, v))
      terms.emplace_back(weight, before[from]);
    const bool blend = a.carry.subdivision == CarryRule::blend,
               unset = a.carry.subdivision == CarryRule::unset;
    const V wanted = unset || (is_new && !blend) ? a.default_value : sum_of(terms);
    wrong += !near(after[v], wanted) && !same(after[v], wanted);
  }
  return wrong;
}
template <class V>
std::size_t wrong_after(const Step& s, const Attribute<Edge, V>& a) {
  const auto before = *find_map(s.before, a), after = *find_map(s.after, a);
  std::map<Edge, V> wanted;
  if (s.cuts_edges && a.carry.subdivision == CarryRule::halves)
    for (Edge e : s.before.edges())
      for (Edge half : s.halves_of(e)) wanted[half] = before[e];
  std::size_t wrong = 0;
  for (Edge e : s.after.edges())
    wrong += !same(V(after[e]), wanted.count(e) ? wanted.at(e) : a.default_value);
  return wrong;
}
template <class V>
std::size_t wrong_after(const Step& s, const Attribute<Face, V>& a) {
  const auto before = *find_map(s.before, a), after = *find_map(s.after, a);
  std::size_t wrong = 0;
  for (Face f : s.after.faces()) {
    const bool is_old = f.idx() < s.before.number_of_faces();
    const bool copy = a.carry.subdivision == CarryRule::copy;
    wrong += !same(after[f], copy ? before[s.parent(f)] : is_old ? before[f] : a.default_value);
  }
  return wrong;
}
template <class V>
std::size_t wrong_after(const Step& s, const Attribute<Halfedge, V>& a) {
  const auto before = *find_map(s.before, a), after = *find_map(s.after, a);
  std::size_t wrong = 0;
  for (Halfedge h : s.after.halfedges()) {
    V wanted = a.default_value;
    if (!s.after.is_border(h) && a.carry.subdivision == CarryRule::blend) {
      const Vertex v = s.after.target(h);
      const bool centre = !s.cuts_edges && v.idx() >= s.before.number_of_vertices();
      const Face face = centre ? Face(static_cast<Mesh::size_type>(v.idx() - s.before.number_of_vertices()))
                               : s.parent(s.after.face(h));
      std::vector<std::pair<double, V>> terms;
      for (const auto& [weight, corner] : origin_of(s.before, s.cuts_edges, v))
        terms.emplace_back(weight, corner_value(s.before, before, face, corner));
      wanted = sum_of(terms);
    }
    wrong += !near(after[h], wanted) && !same(after[h], wanted);
  }
  return wrong;
}

void check_subdivision(bool cuts_edges, std::size_t parts, const Subdivide& subdivide) {
  Mesh before = jittered(3, 3, 0.2, 5);
  fill_attributes(before);
  Mesh after = before;
  subdivide(after);
  const Step step{before, after, cuts_edges};
  std::map<Face, std::size_t> children;
  for (Face f : after.faces()) ++children[step.parent(f)];
  CHECK(after.number_of_faces() == parts * before.number_of_faces());
  for (const auto& [face, n] : children) CHECK((n == parts || !cuts_edges));
  for_each_attribute([&](const auto& a) {
    if (a.carry.subdivision == CarryRule::computed) return;
    INFO(a.name);
    CHECK(wrong_after(step, a) == 0);
  });
}

}  // namespace

TEST_CASE("attributes: the register names every attribute once, with rules that fit its elements") {
  std::stringstream text;
  for (const char* name : {"property_names.h", "warp_map.h", "press_map.h"})
    text << std::ifstream(std::string(FURROW_SOURCE_DIR "/geometry/mesh/") + name).rdbuf();
  const std::string header = text.str();
  std::set<std::string> defined;  // {"v:line", …
  const std::regex definition("\\{\"([vehf]:[a-z_]+)\"");
  for (std::sregex_iterator i(header.begin(), header.end(), definition), end; i != end; ++i)
    defined.insert((*i)[1]);
  std::set<std::string> names;
  std::set<std::pair<std::string, std::string>> columns;
  for_each_attribute([&]<class K, class V>(const Attribute<K, V>& a) {
    INFO(a.name);
    CHECK(names.insert(a.name).second);
    CHECK(fits<K>(a.carry.insertion));
    CHECK(fits<K>(a.carry.subdivision));
    if (a.carry.insertion == CarryRule::computed || a.carry.subdivision == CarryRule::computed)
      CHECK(std::string(a.carry.by) != "");
    CHECK((a.ply.size() > 0) == (a.ply.value != PlyValue::none));
    for (std::size_t k = 0; k < a.ply.size(); ++k)
      CHECK(columns.insert({element_of<K>(), a.ply.names[k]}).second);
  });
  CHECK(names == defined);
}

TEST_CASE("attributes: a split face carries each by its rule") {
  const std::array<Vertex, 3> c = corners_of(grid(4, 4), Face(9));
  check_insertion({[](MeshEditor& e) {
                     e.split_face({Face(9), {0.3, 0.2, 0.5}});
                   },
                   {{0.3, c[0]}, {0.2, c[1]}, {0.5, c[2]}},
                   {Face(9)},
                   {},
                   {}});
}

TEST_CASE("attributes: a split edge carries each by its rule") {
  const Mesh mesh = grid(4, 4);
  for (const bool flag : {true, false}) {  // of an edge with a flag and of one without
    Edge edge;
    for (Edge e : mesh.edges())
      if (!mesh.is_border(e) && value_at<bool>(e.idx()) == flag) edge = e;
    const Halfedge h = mesh.halfedge(edge);
    const Vertex a = mesh.source(h), b = mesh.target(h);
    check_insertion({[=](MeshEditor& e) { e.split_edge(e.mesh().halfedge(a, b), 0.4); },
                     {{0.6, a}, {0.4, b}},
                     {mesh.face(h), mesh.face(mesh.opposite(h))},
                     std::pair(a, b),
                     {}});
  }
}

TEST_CASE("attributes: a flipped edge carries each by its rule") {
  check_insertion({[](MeshEditor& e) { e.flip_edge(*e.edge_between(Vertex(6), Vertex(12))); },
                   {},
                   {},
                   {},
                   std::pair(Vertex(6), Vertex(12))});
}

TEST_CASE("attributes: each subdivision carries each by its rule") {
  check_subdivision(true, 4, [](Mesh& m) { loop_subdivide(m, 1); });
  check_subdivision(true, 4, [](Mesh& m) { midpoint_subdivide(m, 1); });
  check_subdivision(false, 3, [](Mesh& m) { sqrt3_subdivide(m, 1); });
}
