// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>

#include "geometry/mesh/attribute_slots.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/struts.h"
#include "io/base/own_mark.h"
#include "io/mesh/file_frame.h"
#include "io/mesh/mesh_readers.h"
#include "io/mesh/ply_rows.h"
#include "io/mesh/soup_to_mesh.h"

namespace furrow::io {
namespace {

using namespace geometry;
using Columns = std::vector<std::size_t>;  ///< indices of an element's properties
using Names = std::vector<const char*>;

/// The columns of one attribute in this file, and its values, one a row.
template <class A>
struct PlySlot {
  explicit PlySlot(const A& a) : attribute(a) {}
  Names names() const {
    return {attribute.ply.names.begin(), attribute.ply.names.begin() + attribute.ply.size()};
  }
  const A& attribute;
  Columns columns;  ///< empty: the file has none
  std::vector<typename A::Value> values;
};

Names names_of(const PropertyName<Halfedge, double>& attribute) {
  Names names;
  AttributeSlots<PlySlot, Halfedge>().for_each([&](const auto& slot) {
    if (slot.attribute.name == std::string_view(attribute.name)) names = slot.names();
  });
  return names;
}

/// The columns of the first of these groups of numbers that is whole.
Columns find_group(const PlyElement& element, const std::vector<Names>& groups) {
  for (const Names& group : groups) {
    Columns columns;
    for (const char* name : group)
      if (const auto column = find_column(element, {name}, PlyKind::number)) columns.push_back(*column);
    if (columns.size() == group.size()) return columns;
  }
  return {};
}

const std::vector<Names> color_names = {
    {"red", "green", "blue", "alpha"}, {"red", "green", "blue"}, {"r", "g", "b", "a"}, {"r", "g", "b"}};
const std::vector<Names> texture_names = {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}};

struct MeshEdge {
  std::size_t a, b;  ///< the soup's points, a <= b
  Edge edge;
};

std::vector<MeshEdge> sorted_edges(const SoupMesh& mesh) {
  std::vector<MeshEdge> edges;
  edges.reserve(mesh.mesh.number_of_edges());
  for (const Edge e : mesh.mesh.edges()) {
    const std::size_t a = mesh.origin[mesh.mesh.vertex(e, 0)], b = mesh.origin[mesh.mesh.vertex(e, 1)];
    edges.push_back({std::min(a, b), std::max(a, b), e});
  }
  std::ranges::sort(edges, [](const MeshEdge& p, const MeshEdge& q) {
    return std::tie(p.a, p.b, p.edge) < std::tie(q.a, q.b, q.edge);
  });
  return edges;
}

/// The ends of an edge or a strut as the file numbers its vertices, a <= b.
struct Ends {
  std::size_t a, b;
};

struct StrutRow {
  Ends ends;
  double rest_length, stiffness;
};

class PlyReader {
 public:
  PlyReader(std::string_view text, const std::string& name, const ReadOptions& options)
      : name_(name),
        options_(options),
        scanner_(text, name),
        header_(read_ply_header(scanner_, text.size())),
        rows_(scanner_, text, header_.encoding) {}

  MeshFile read() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element);
      else if (element.name == "tristrips" && !has_faces())
        read_strips(element);
      else if (element.name == "edge" && find_edge_columns(element))
        read_edges(element);
      else if (element.name == "strut" && find_group(element, {strut_names}).size() == strut_names.size())
        read_struts(element);
      else
        skip(element);
    }
    finish_textures();
    take_comments();
    soup_.has_lines = !struts_.empty();
    SoupMesh mesh = soup_to_mesh(soup_, name_, options_.chains);
    fill_edges(mesh);
    fill_struts(mesh.mesh);
    fill(of_vertices_, mesh.mesh, mesh.mesh.vertices(), mesh.origin);
    fill(of_faces_, mesh.mesh, mesh.mesh.faces(), mesh.face_origin);
    file_.mesh = std::move(mesh.mesh);
    file_.repairs = mesh.repairs;
    return std::move(file_);
  }

 private:
  /// Whether the columns of a cloth in motion are ours; in another program's file they may mean anything.
  bool is_state() const {
    return std::ranges::any_of(header_.comments,
                               [](const std::string& c) { return c.starts_with("furrow state "); });
  }

  void warn_of_unknown(const PlyElement& element, const Names& known) {
    std::string names;
    for (const PlyProperty& p : element.properties)
      if (std::ranges::find(known, p.name) == known.end()) names += (names.empty() ? "" : ", ") + p.name;
    if (!names.empty())
      file_.warnings.push_back(name_ + ": properties of '" + element.name + "' not read: " + names);
  }

  void skip(const PlyElement& element) {
    for (std::size_t i = 0; i < element.count; ++i) rows_.read(element, i, row_);
    file_.warnings.push_back(name_ + ": element '" + element.name + "' not read");
  }

  // ------------------------------------------------------------------------------------------------ values

  /// The number in SI units. NaN passes: it is unset.
  double checked(PlyValue kind, const char* name, double value) const {
    switch (kind) {
      case PlyValue::length: {
        const double metres = value * options_.metres_per_unit;
        if (metres <= 0 || std::isinf(metres))
          rows_.fail("a rest length must be > 0 and finite, or nan for none");
        return metres;
      }
      case PlyValue::stiffness:
        if (value < 0 || std::isinf(value))
          rows_.fail("a stiffness must be >= 0 and finite, or nan for none");
        return value;
      case PlyValue::angle:
        if (std::abs(value) > std::numbers::pi)
          rows_.fail("a rest angle must be in [-pi, pi], or nan for none");
        return value;
      case PlyValue::mass:
        if (value < 0 || std::isinf(value))
          rows_.fail("a mass must be at least 0 kg and finite, or nan for none");
        return value;
      default:
        if (std::isinf(value)) fail_state(name);
        return value;
    }
  }

  [[noreturn]] void fail_state(const char* name) const {
    rows_.fail(std::string("'") + name + "' is not finite; write the state again");
  }

  int whole(double value, const char* what) const {
    constexpr double largest_value = std::numeric_limits<int>::max();
    if (!(value >= -1 && value <= largest_value) || value != std::floor(value))
      rows_.fail(std::string("the property '") + what + "' must be whole and at least -1 (none)");
    return static_cast<int>(value);
  }

  int small_count(double value) const {
    if (!(value >= 0 && value <= 1e6) || value != std::floor(value))
      rows_.fail("a count must be whole, from 0 to 1e6");
    return static_cast<int>(value);
  }

  double value_of(const PlyColumns& ply, const Columns& c, double) const {
    return checked(ply.value, ply.names[0], row_.numbers[c[0]]);
  }
  int value_of(const PlyColumns& ply, const Columns& c, int) const {
    const double value = row_.numbers[c[0]];
    return ply.value == PlyValue::index ? whole(value, ply.names[0]) : small_count(value);
  }
  bool value_of(const PlyColumns&, const Columns& c, bool) const {
    return small_count(row_.numbers[c[0]]) != 0;
  }
  Vector value_of(const PlyColumns& ply, const Columns& c, const Vector&) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (!std::isfinite(row_.numbers[c[k]])) fail_state(ply.names[k]);
    return {row_.numbers[c[0]], row_.numbers[c[1]], row_.numbers[c[2]]};
  }
  RestPosition value_of(const PlyColumns& ply, const Columns& c, const RestPosition& unset) const {
    const double x = row_.numbers[c[0]], y = row_.numbers[c[1]], z = row_.numbers[c[2]];
    if (std::isnan(x) && std::isnan(y) && std::isnan(z)) return unset;
    if (ply.value == PlyValue::direction) {
      if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
        rows_.fail("a direction of the warp is not finite; write three numbers, or three nan for none");
      const Vector v = turned_from_file({x, y, z}, options_.up);
      return {v.x(), v.y(), v.z()};
    }
    const auto point = from_file(x, y, z, options_);
    if (!point) rows_.fail(std::string("a rest position: ") + bad_coordinate);
    return {point->x(), point->y(), point->z()};
  }
  Color value_of(const PlyColumns&, const Columns& rgba, Color c) const {
    for (std::size_t k = 0; k < rgba.size(); ++k) {
      const PlyType type = element_->properties[rgba[k]].type;
      const double most = !is_integer(type)    ? 1
                          : size_of(type) == 1 ? 255
                          : size_of(type) == 2 ? 65535
                                               : 4294967295.0;
      c[k] = row_.numbers[rgba[k]] / most;
      if (!std::isfinite(c[k])) rows_.fail("a colour is not finite; correct it");
    }
    return c;
  }

  /// Takes the values of this row for all columns that were found.
  template <class Slots>
  void take(Slots& slots) {
    slots.for_each([&](auto& slot) {
      if (!slot.columns.empty())
        slot.values.push_back(value_of(slot.attribute.ply, slot.columns, slot.attribute.default_value));
    });
  }

  void next_row(const PlyElement& element, std::size_t index) {
    element_ = &element;
    rows_.read(element, index, row_);
  }

  /// The maps of what was found; key i of the mesh has the values of row origin[i].
  template <class Slots, class Keys>
  static void fill(const Slots& slots, Mesh& mesh, const Keys& keys, const std::vector<std::size_t>& origin) {
    slots.for_each([&](const auto& slot) {
      if (slot.columns.empty()) return;
      auto map = ensure_map(mesh, slot.attribute);
      for (const auto key : keys) map[key] = slot.values[origin[key]];
    });
  }

  // ---------------------------------------------------------------------------------------------- vertices

  void read_vertices(const PlyElement& element) {
    const Columns xyz = find_group(element, {{"x", "y", "z"}});
    const Columns texture = faces_have_texture() ? Columns{} : find_group(element, texture_names);
    const Columns others = find_vertex_columns(element, texture);
    if (xyz.empty()) rows_.fail("the vertices have no x, y and z");
    for (const std::size_t i : others) soup_.attributes.push_back({element.properties[i].name, {}});
    warn_of_lists(element);
    for (std::size_t i = 0; i < element.count; ++i) {
      next_row(element, i);
      const auto& n = row_.numbers;
      const auto point = from_file(n[xyz[0]], n[xyz[1]], n[xyz[2]], options_);
      if (!point) rows_.fail(bad_coordinate);
      soup_.points.push_back(*point);
      if (!texture.empty()) vertex_textures_.push_back({n[texture[0]], n[texture[1]]});
      take(of_vertices_);
      for (std::size_t k = 0; k < others.size(); ++k) soup_.attributes[k].values.push_back(n[others[k]]);
    }
  }

  /// A name belongs to an attribute only if all of its columns are there; else it is one of the others, which
  /// this returns: numbers at vertices that we have no use for are kept under their names
  /// (vertex_attributes.h). Normals are made anew.
  Columns find_vertex_columns(const PlyElement& element, const Columns& texture) {
    std::set<std::string> used;
    const auto use = [&](const Columns& columns) {
      for (const std::size_t c : columns) used.insert(element.properties[c].name);
    };
    use(texture);
    use(find_group(element, {{"x", "y", "z"}}));
    use(find_group(element, {{"nx", "ny", "nz"}}));
    if (faces_have_texture()) use(find_group(element, {{"s", "t"}}));  // the same again, for Blender
    of_vertices_.for_each([&](auto& slot) {
      const PlyValue kind = slot.attribute.ply.value;
      if (kind == PlyValue::none || (kind == PlyValue::state && !is_state())) return;
      slot.columns =
          find_group(element, kind == PlyValue::color ? color_names : std::vector<Names>{slot.names()});
      use(slot.columns);
    });
    Columns others;
    for (std::size_t i = 0; i < element.properties.size(); ++i)
      if (!element.properties[i].count_type && used.insert(element.properties[i].name).second)
        others.push_back(i);
    return others;
  }

  void warn_of_lists(const PlyElement& element) {
    std::string lists;
    for (const PlyProperty& p : element.properties)
      if (p.count_type) lists += (lists.empty() ? "" : ", ") + p.name;
    if (!lists.empty()) file_.warnings.push_back(name_ + ": lists of 'vertex' not read: " + lists);
  }

  bool faces_have_texture() const {
    return std::ranges::any_of(header_.elements, [](const PlyElement& e) {
      return e.name == "face" && find_column(e, {"texcoord"}, PlyKind::list);
    });
  }

  // ------------------------------------------------------------------------------------------------- faces

  void read_faces(const PlyElement& element) {
    const auto indices = find_column(element, {"vertex_indices", "vertex_index"}, PlyKind::list);
    const auto texcoord = find_column(element, {"texcoord"}, PlyKind::list),
               second = find_column(element, {"texcoord_2"}, PlyKind::list);
    const Names length_names = names_of(attribute::triangle_rest_length);
    const Columns lengths = find_group(element, {length_names});
    Names known{"vertex_indices", "vertex_index", "texcoord", "texcoord_2"};
    if (!lengths.empty()) known.insert(known.end(), length_names.begin(), length_names.end());
    of_faces_.for_each([&](auto& slot) {
      slot.columns = find_group(element, {slot.names()});
      for (const char* name : slot.names()) known.push_back(name);
    });
    warn_of_unknown(element, known);
    if (!indices) rows_.fail("the faces have no list vertex_indices");
    for (std::size_t i = 0; i < element.count; ++i) {
      next_row(element, i);
      const auto& corners = row_.lists[*indices];
      for (const double c : corners) soup_.corners.push_back(corner(c));
      soup_.close_face();
      if (texcoord) add_textures(row_.lists[*texcoord], corners.size(), soup_.textures);
      if (second) add_textures(row_.lists[*second], corners.size(), soup_.second_textures);
      if (!lengths.empty()) add_triangle_lengths(lengths, corners.size());
      take(of_faces_);
    }
  }

  bool has_faces() const {
    return std::ranges::any_of(header_.elements,
                               [](const PlyElement& e) { return e.name == "face" && e.count > 0; });
  }

  /// Triangles of three neighbours in a list, every other one turned; -1 begins a new strip.
  void read_strips(const PlyElement& element) {
    const auto indices = find_column(element, {"vertex_indices", "vertex_index"}, PlyKind::list);
    if (!indices) rows_.fail("the strips have no list vertex_indices");
    for (std::size_t i = 0; i < element.count; ++i) {
      next_row(element, i);
      std::vector<std::size_t> strip;
      for (const double c : row_.lists[*indices]) {
        if (c == -1) strip.clear();
        if (c == -1) continue;
        strip.push_back(corner(c));
        if (strip.size() >= 3) add_of_strip(strip);
      }
    }
  }

  /// The last triangle; a strip turns a corner by triangles without area.
  void add_of_strip(const std::vector<std::size_t>& strip) {
    const std::size_t n = strip.size(), a = strip[n - 3], b = strip[n - 2], c = strip[n - 1];
    if (a == b || b == c || c == a) return;
    for (const std::size_t v : n % 2 ? std::array{a, b, c} : std::array{b, a, c}) soup_.corners.push_back(v);
    soup_.close_face();
  }

  std::size_t corner(double c) const {
    if (!(c >= 0 && c < 9e15) || c != std::floor(c))
      rows_.fail("a corner is no index of a vertex; correct it");
    return static_cast<std::size_t>(c);
  }

  void add_textures(const std::vector<double>& values, std::size_t corners,
                    std::vector<TextureCoordinate>& textures) const {
    if (values.size() != 2 * corners && !values.empty())
      rows_.fail("texcoord must hold two numbers a corner, or none");
    for (std::size_t k = 0; k < corners; ++k)
      textures.push_back(values.empty() ? attribute::texture.default_value
                                        : TextureCoordinate{values[2 * k], values[2 * k + 1]});
  }

  void add_triangle_lengths(const Columns& columns, std::size_t corners) {
    for (const std::size_t column : columns) {
      const double value = checked(PlyValue::length, "", row_.numbers[column]);
      if (corners == 3) soup_.triangle_rest_lengths.push_back(value);
      if (corners != 3 && !std::isnan(value)) rows_.fail("only triangles have rest lengths of their own");
    }
    soup_.triangle_rest_lengths.resize(soup_.corners.size(), unset_value);
  }

  /// Texture coordinates of vertices go to all their corners, if the faces bring none.
  void finish_textures() {
    if (vertex_textures_.empty() || !soup_.textures.empty()) return;
    for (const std::size_t c : soup_.corners)
      soup_.textures.push_back(c < vertex_textures_.size() ? vertex_textures_[c]
                                                           : attribute::texture.default_value);
  }

  // ------------------------------------------------------------------------------------- edges and struts

  Ends read_ends(const Columns& columns, const char* what) const {
    const double a = row_.numbers[columns[0]], b = row_.numbers[columns[1]];
    const auto is_index = [](double x) { return x >= 0 && x < 9e15 && x == std::floor(x); };
    if (!is_index(a) || !is_index(b))
      rows_.fail(std::string("an end of ") + what + " is no index of a vertex; correct it");
    return {static_cast<std::size_t>(std::min(a, b)), static_cast<std::size_t>(std::max(a, b))};
  }

  /// Whether the element has ends and any column that we read.
  bool find_edge_columns(const PlyElement& element) {
    bool any = false;
    of_edges_.for_each([&](auto& slot) {
      if (slot.attribute.ply.value != PlyValue::none) slot.columns = find_group(element, {slot.names()});
      any = any || !slot.columns.empty();
    });
    if (any && !find_group(element, {end_names}).empty()) return true;
    of_edges_.for_each([](auto& slot) { slot.columns.clear(); });
    return false;
  }

  void read_edges(const PlyElement& element) {
    Names known = end_names;
    of_edges_.for_each([&](const auto& slot) {
      for (const char* name : slot.names()) known.push_back(name);
    });
    warn_of_unknown(element, known);
    const Columns ends = find_group(element, {end_names});
    for (std::size_t i = 0; i < element.count; ++i) {
      next_row(element, i);
      edges_.push_back(read_ends(ends, "an edge"));
      take(of_edges_);
    }
  }

  /// An edge of the file stands for every edge of the mesh between copies of its two points.
  void fill_edges(SoupMesh& mesh) const {
    std::vector<std::pair<Edge, std::size_t>> matches;  // with the row of the file
    const auto ends_of = [](const MeshEdge& m) { return std::pair(m.a, m.b); };
    const std::vector<MeshEdge> sorted = edges_.empty() ? std::vector<MeshEdge>{} : sorted_edges(mesh);
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const auto& [a, b] = edges_[i];
      const auto first = std::ranges::lower_bound(sorted, std::pair(a, b), {}, ends_of);
      const auto last = std::ranges::upper_bound(sorted, std::pair(a, b), {}, ends_of);
      if (first == last)
        throw ContentError(name_ + ": edge " + std::to_string(i) + ": no face has an edge between vertices " +
                           std::to_string(a) + " and " + std::to_string(b) + "; remove it");
      for (auto m = first; m != last; ++m) matches.emplace_back(m->edge, i);
    }
    of_edges_.for_each([&](const auto& slot) {
      if (slot.columns.empty()) return;
      auto map = ensure_map(mesh.mesh, slot.attribute);
      for (const auto& [edge, row] : matches) map[edge] = slot.values[row];
    });
  }

  void read_struts(const PlyElement& element) {
    warn_of_unknown(element, strut_names);
    const Columns columns = find_group(element, {strut_names});
    for (std::size_t i = 0; i < element.count; ++i) {
      next_row(element, i);
      const Ends ends = read_ends(columns, "a strut");
      if (ends.a == ends.b) rows_.fail("both ends of a strut are one vertex; remove it");
      const double rest = checked(PlyValue::length, "", row_.numbers[columns[2]]);
      const double stiffness = checked(PlyValue::stiffness, "", row_.numbers[columns[3]]);
      if (std::isnan(rest) || std::isnan(stiffness))
        rows_.fail("a strut needs a rest length and a stiffness");
      struts_.push_back({ends, rest, stiffness});
    }
  }

  /// Vertices keep the file's indices.
  void fill_struts(Mesh& mesh) const {
    std::vector<Strut> list;
    const auto vertex = [](std::size_t i) { return Vertex(static_cast<Vertex::size_type>(i)); };
    for (std::size_t i = 0; i < struts_.size(); ++i) {
      const auto& [ends, rest_length, stiffness] = struts_[i];
      if (ends.b >= soup_.points.size())
        throw ContentError(name_ + ": strut " + std::to_string(i) + ": names vertex " +
                           std::to_string(ends.b) + " of " + std::to_string(soup_.points.size()) +
                           "; correct or remove it");
      list.push_back({vertex(ends.a), vertex(ends.b), rest_length, stiffness});
    }
    set_struts(mesh, list);
  }

  // ---------------------------------------------------------------------------------------------- comments

  /// "furrow group 3 sleeve" names a group, "furrow material 0 cotton" a material; the rest is kept.
  void take_comments() {
    for (std::string& comment : header_.comments)
      if (comment != own_mark && !take_name(comment, "furrow group ", file_.group_names) &&
          !take_name(comment, "furrow material ", file_.material_names))
        file_.comments.push_back(std::move(comment));
  }

  static bool take_name(std::string_view comment, std::string_view mark, std::vector<std::string>& names) {
    if (!comment.starts_with(mark)) return false;
    comment.remove_prefix(mark.size());
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(comment.data(), comment.data() + comment.size(), index);
    if (error != std::errc() || index > 100000) return false;
    comment.remove_prefix(static_cast<std::size_t>(end - comment.data()));
    if (comment.starts_with(' ')) comment.remove_prefix(1);
    if (names.size() <= index) names.resize(index + 1);
    names[index] = comment;
    return true;
  }

  inline static const Names end_names = {"vertex1", "vertex2"};
  inline static const Names strut_names = {"vertex1", "vertex2", "rest_length", "stiffness"};
  std::string name_;
  ReadOptions options_;
  TextScanner scanner_;
  PlyHeader header_;
  PlyRows rows_;
  PlyRow row_;
  const PlyElement* element_ = nullptr;  ///< that of row_
  PolygonSoup soup_;
  AttributeSlots<PlySlot, Vertex> of_vertices_;
  AttributeSlots<PlySlot, Face> of_faces_;
  AttributeSlots<PlySlot, Edge> of_edges_;
  std::vector<Ends> edges_;
  std::vector<StrutRow> struts_;
  std::vector<TextureCoordinate> vertex_textures_;
  MeshFile file_;
};

}  // namespace

MeshFile read_ply(std::string_view text, const std::string& name, const ReadOptions& options) {
  return PlyReader(text, name, options).read();
}

}  // namespace furrow::io
