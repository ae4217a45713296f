// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bridge/arrays/convert.h"
#include "geometry/figure/border_seams.h"
#include "geometry/figure/close_holes.h"
#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "io/mesh/merge_points.h"
#include "jobs/base/gate.h"
#include "jobs/base/read_inputs.h"
#include "jobs/base/seam_ties.h"

namespace furrow::jobs {
namespace {

using geometry::Face;
using geometry::Mesh;
using geometry::Point;
using geometry::Vertex;

constexpr std::size_t most_marks = 50;    // of one ailment
constexpr double soup_share = 0.5;        // of vertices that lie where others do
constexpr double shell = 0.008;           // [m] thickness of a garment that was given two sides
constexpr double odd_ratio = 30;          // of two sizes that are of one unit, at most
constexpr std::size_t edges_of_hole = 8;  // edges
constexpr double thickest_cloth = 0.03;   // [m] with two sides
constexpr double most_filled = 0.35;      // of a figure's box
constexpr double longest_neck = 0.3;      // of a border that a closed body may have, of the mesh's diagonal
constexpr double smallest_person = 0.9, largest_person = 2.5, person_volume = 0.012;  // [m], [m^3]

std::string three_digits(double value) { return fmt::format("{:.3g}", value); }

Eigen::AlignedBox3d box_of(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (Vertex v : mesh.vertices())
    if (!mesh.is_isolated(v)) box.extend(bridge::to_eigen(mesh.point(v)));
  return box;
}

double size_of(const Eigen::AlignedBox3d& box) { return box.isEmpty() ? 0 : box.diagonal().norm(); }

std::array<Vertex, 3> corners_of(const Mesh& mesh, Face f) {
  const geometry::Halfedge h = mesh.halfedge(f);
  return {mesh.source(h), mesh.target(h), mesh.target(mesh.next(h))};
}

Point middle_of(const Mesh& mesh, Face f) {
  const auto [a, b, c] = corners_of(mesh, f);
  return CGAL::centroid(mesh.point(a), mesh.point(b), mesh.point(c));
}

/// Told of by the reader, when it repairs.
void add_repairs(const io::RepairReport& r, std::vector<Ailment>& found) {
  const auto add = [&](std::size_t n, const char* code, const std::string& what) {
    if (n == 0) return;
    Ailment a{code, std::to_string(n) + " " + what, "`furrow doctor repair` writes them so"};
    a.count = n, a.mendable = true, a.told_by_reader = true;
    found.push_back(std::move(a));
  };
  add(r.degenerate_faces, "degenerate_faces", "faces have a corner twice; they are dropped");
  add(r.duplicate_faces, "duplicate_faces", "faces are there twice; they are dropped");
  add(r.reversed_faces, "reversed_faces", "faces are wound against their neighbours; they are turned");
  add(r.duplicated_vertices, "not_manifold",
      "vertices were doubled where three or more faces meet at an edge, or fans at a vertex; they are tied "
      "together when the cloth moves");
}

/// The number of each vertex's place, in the order of first occurrence.
struct Places {
  std::vector<std::size_t> of_vertex;
  std::vector<Vertex> doubled;  ///< vertices that lie where an earlier one does
  std::size_t used = 0;         ///< vertices that have faces
};

Places places_of(const Mesh& mesh, std::size_t own_vertices) {
  Places places;
  places.of_vertex.resize(mesh.num_vertices());
  std::vector<char> tied(mesh.num_vertices(), 0);
  for (const auto& [a, b] : seam_ties(mesh)) tied[b.idx()] = 1;
  io::PointNumbers numbers;
  for (Vertex v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;
    const auto [number, is_new] = numbers.number(mesh.point(v));
    places.of_vertex[v.idx()] = number;
    ++places.used;
    if (!is_new && v.idx() < own_vertices && !tied[v.idx()]) places.doubled.push_back(v);
  }
  return places;
}

void add_doubled(const Mesh& mesh, const Places& places, std::vector<Ailment>& found) {
  if (places.doubled.empty()) return;
  const double share = double(places.doubled.size()) / double(places.used);
  const bool soup = share > soup_share;
  Ailment a;
  a.code = soup ? "soup" : "unjoined";
  a.text = std::to_string(places.doubled.size()) + " of " + std::to_string(places.used) +
           " vertices lie where another does" +
           (soup ? ": the file is a soup of loose triangles, which would fall apart"
                 : ": what meets there is not joined");
  a.help = "`furrow doctor repair` joins them";
  a.count = places.doubled.size();
  a.fatal = soup;
  a.mendable = true;
  for (Vertex v : places.doubled)
    if (a.places.size() < most_marks) a.places.push_back(mesh.point(v));
  found.push_back(std::move(a));
}

/// Seams that lie open by a rounding, and by vertices amid their edges.
void add_open_seams(const Mesh& mesh, std::vector<Ailment>& found) {
  const geometry::BorderSeams seams = geometry::find_border_seams(mesh);
  const auto add = [&](const char* code, std::size_t count, const std::string& what, const auto& place_of) {
    if (count == 0) return;
    Ailment a{code, "", "`furrow doctor repair` joins them"};
    a.count = count, a.mendable = true;
    for (std::size_t i = 0; i < std::min(count, most_marks); ++i) a.places.push_back(place_of(i));
    const Point& p = a.places[0];
    a.text = fmt::format("{}{}: what meets there is not joined; the first at ({:.3f}, {:.3f}, {:.3f}) m",
                         count, what, p.x(), p.y(), p.z());
    found.push_back(std::move(a));
  };
  add("seams_apart", seams.apart.size(),
      " vertices of seams lie up to " + geometry::length_text(seams.gap) +
          " from the other side (a seam is joined within 1/100 of its edges, here " +
          geometry::length_text(seams.tolerance) + ")",
      [&](std::size_t i) { return mesh.point(seams.apart[i]); });
  add("t_junctions", seams.splits.size(), " vertices of seams lie amid an edge of the other side",
      [&](std::size_t i) { return mesh.point(seams.splits[i].at); });
}

/// How many faces lie on another that has the same three places.
std::size_t count_backed(const Mesh& mesh, const Places& places, std::vector<Point>& where) {
  std::vector<std::pair<std::array<std::size_t, 3>, Face>> keys;
  for (Face f : mesh.faces()) {
    const auto [a, b, c] = corners_of(mesh, f);
    std::array<std::size_t, 3> key{places.of_vertex[a.idx()], places.of_vertex[b.idx()],
                                   places.of_vertex[c.idx()]};
    std::sort(key.begin(), key.end());
    keys.emplace_back(key, f);
  }
  std::sort(keys.begin(), keys.end());
  std::size_t backed = 0;
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (keys[i].first != keys[i - 1].first) continue;
    ++backed;
    if (where.size() < most_marks) where.push_back(middle_of(mesh, keys[i].second));
  }
  return backed;
}

void add_holes(const Mesh& mesh, std::vector<Ailment>& found) {
  Ailment a{"holes", "", "`furrow doctor repair` closes them"};
  double longest = 0;
  for (const geometry::BorderLoop& loop : geometry::small_holes(mesh, edges_of_hole)) {
    ++a.count;
    longest = std::max(longest, loop.length);
    if (a.places.size() < most_marks) a.places.push_back(mesh.point(loop.vertices[0]));
  }
  const geometry::MeshInfo info = geometry::measure(mesh);
  if (a.count == 0 || info.components > mesh.number_of_faces() / 4)
    return;  // loose triangles have such borders
  a.text =
      std::to_string(a.count) + " small holes, of " + geometry::length_text(longest) + " around and less";
  a.mendable = true;
  found.push_back(std::move(a));
}

void add_flat_faces(const Mesh& mesh, std::vector<Ailment>& found) {
  Ailment a{"no_area", "", ""};
  for (Face f : mesh.faces()) {
    const auto [u, v, w] = corners_of(mesh, f);
    const Point &p = mesh.point(u), &q = mesh.point(v), &r = mesh.point(w);
    const double longest =
        std::max({CGAL::squared_distance(p, q), CGAL::squared_distance(q, r), CGAL::squared_distance(r, p)});
    if (std::sqrt(CGAL::squared_area(p, q, r)) >= 1e-12 * longest && longest > 0) continue;
    ++a.count;
    if (a.places.size() < most_marks) a.places.push_back(middle_of(mesh, f));
  }
  if (a.count == 0) return;
  a.text = std::to_string(a.count) + " faces have no area";
  a.help = "merge their vertices where the mesh was made";
  found.push_back(std::move(a));
}

/// Whether no border is longer than a neck's or a wrist's: eyes and mouths may be open, hems are not.
bool nearly_closed(const Mesh& mesh, const Eigen::AlignedBox3d& box) {
  const double longest = longest_neck * size_of(box);
  const std::vector<geometry::BorderLoop> loops = geometry::border_loops(mesh);
  return std::all_of(loops.begin(), loops.end(),
                     [&](const geometry::BorderLoop& loop) { return loop.length < longest; });
}

double volume_of(const Mesh& mesh, const Eigen::Vector3d& from) {
  double volume = 0;
  for (Face f : mesh.faces()) {
    const auto [a, b, c] = corners_of(mesh, f);
    const auto at = [&](Vertex v) -> Eigen::Vector3d { return bridge::to_eigen(mesh.point(v)) - from; };
    volume += at(a).dot(at(b).cross(at(c))) / 6;
  }
  return std::abs(volume);
}

/// Whether a mesh may be a person: nearly closed, of a person's volume, which fills a part of its box only (a
/// slab or a bench fills more).
bool is_figure(const Mesh& mesh, const Eigen::AlignedBox3d& box) {
  if (!nearly_closed(mesh, box)) return false;
  const double volume = volume_of(mesh, box.center());
  return volume >= person_volume && volume <= 0.25 && volume < most_filled * box.volume();
}

}  // namespace

std::vector<Ailment> faults_of_mesh(const io::MeshFile& file) {
  std::vector<Ailment> found;
  add_repairs(file.repairs, found);
  const std::size_t own = file.mesh->num_vertices() - file.repairs.duplicated_vertices;
  add_doubled(file.mesh, places_of(file.mesh, own), found);
  if (found.empty() || found.back().code != "soup") add_open_seams(file.mesh, found);
  add_flat_faces(file.mesh, found);
  add_holes(file.mesh, found);
  return found;
}

std::vector<Ailment> faults_of_garment(const Mesh& garment) {
  Ailment a{"two_sided", "", "delete the inner side where the garment was made: cloth is one layer here"};
  a.count = count_backed(garment, places_of(garment, garment.num_vertices()), a.places);
  if (2 * a.count > 0.5 * double(garment.number_of_faces())) {
    a.text = std::to_string(a.count) +
             " faces lie on others of the same corners: the garment has two sides, twice its weight";
    a.help = "`furrow doctor repair` takes off one";
    a.mendable = true;
    return {a};
  }
  a.places.clear();
  const geometry::MeshInfo info = geometry::measure(garment);
  if (!info.closed || !info.volume || !(info.area > 0.02)) return {};
  const double thickness = 2 * std::abs(*info.volume) / info.area;
  if (thickness > shell) return {};
  a.count = info.faces;
  a.text = "the garment is a closed shell " + geometry::length_text(thickness) +
           " thick: it has an inner and an outer side, which know nothing of each other";
  return {a};
}

std::vector<Ailment> faults_of_body(const Mesh& body, bool up_said) {
  const Eigen::AlignedBox3d box = box_of(body);
  if (box.isEmpty() || up_said) return {};
  const Eigen::Vector3d size = box.sizes();
  const bool long_enough = size.z() >= smallest_person && size.z() <= largest_person;
  if (!long_enough || size.y() > 0.35 * size.z() || size.x() > 1.15 * size.z()) return {};
  if (!is_figure(body, box)) return {};
  Ailment a{"z_up", "", "`up=z`"};
  a.text = "the body is " + three_digits(size.z()) + " m long along z and only " + three_digits(size.y()) +
           " m high, as a figure of a file whose z axis points up; say `up=z`, or `up=y` if it is to lie";
  a.fatal = true;
  return {a};
}

BodyOutline outline_of(const Mesh& body) {
  const Eigen::AlignedBox3d box = box_of(body);
  const bool closed = nearly_closed(body, box);
  const bool figure = closed && !box.isEmpty() && volume_of(body, box.center()) < most_filled * box.volume();
  return {box, geometry::measure(body).closed, closed, figure};
}

namespace {

/// Whether what was given as the garment is a body: a closed figure, thicker than cloth with two sides.
bool is_body(const Mesh& garment, const Eigen::AlignedBox3d& box, bool closed) {
  const double tall = box.sizes().y();
  if (tall < smallest_person || tall > largest_person || !is_figure(garment, box)) return false;
  return !closed || 2 * volume_of(garment, box.center()) > thickest_cloth * geometry::measure(garment).area;
}

std::optional<Ailment> exchanged(const Mesh& garment, const BodyOutline& body) {
  const Eigen::AlignedBox3d box = box_of(garment);
  if (body.closed || box.isEmpty()) return std::nullopt;
  const bool closed = geometry::measure(garment).closed;
  if ((body.nearly_closed && !closed) || !is_body(garment, box, closed)) return std::nullopt;
  Ailment a{"exchanged", "", "`body`"};
  a.text = "the garment is closed, a figure of " + three_digits(1000 * volume_of(garment, box.center())) +
           " litres, and the body is open: are they exchanged? the garment comes first, the body goes with "
           "`body`";
  a.fatal = true;
  return a;
}

/// The body given as the garment, too: their boxes are one.
std::optional<Ailment> worn_on_itself(const Eigen::AlignedBox3d& garment, const BodyOutline& body) {
  if (garment.isEmpty() || body.box.isEmpty()) return std::nullopt;
  const double off = std::max((garment.min() - body.box.min()).cwiseAbs().maxCoeff(),
                              (garment.max() - body.box.max()).cwiseAbs().maxCoeff());
  if (off > 1e-6 * size_of(garment)) return std::nullopt;
  Ailment a{"worn_on_itself", "", "`body`"};
  a.text =
      "the body is the garment itself, and nothing is worn on itself: name the body with `body`, in a file "
      "that does not hold the garment";
  a.fatal = true;
  return a;
}

/// A closed figure in place of cloth.
std::optional<Ailment> body_as_garment(const Mesh& garment) {
  const Eigen::AlignedBox3d box = box_of(garment);
  if (box.isEmpty() || !geometry::measure(garment).closed || !is_body(garment, box, true))
    return std::nullopt;
  Ailment a{"body_as_garment", "", "name the garment in its place"};
  a.text = "the garment is closed, a figure of " + three_digits(1000 * volume_of(garment, box.center())) +
           " litres: a body, and no cloth; " + a.help;
  a.fatal = true;
  return a;
}

/// Length of the border that lies in the plane of the axis, within the tolerance [m].
double border_in_plane(const Mesh& mesh, int axis, double plane, double tolerance) {
  double length = 0;
  for (const geometry::Edge e : mesh.edges()) {
    const Point &a = mesh.point(mesh.vertex(e, 0)), &b = mesh.point(mesh.vertex(e, 1));
    if (mesh.is_border(e) && std::abs(a[axis] - plane) < tolerance && std::abs(b[axis] - plane) < tolerance)
      length += std::sqrt(CGAL::squared_distance(a, b));
  }
  return length;
}

/// Half of a garment, whose cut lies in a plane through the middle of the body: a mirror that was not
/// applied.
std::optional<Ailment> half_of_garment(const Mesh& garment, const BodyOutline& body) {
  const Eigen::AlignedBox3d box = box_of(garment);
  if (box.isEmpty() || !box.intersects(body.box)) return std::nullopt;
  const Eigen::Vector3d middle = body.box.center(), size = body.box.sizes();
  for (const int axis : {0, 2}) {
    const int across = 2 - axis;  // a curtain beside somebody hangs on one side of him, and is flat
    if (box.sizes()[axis] < 0.1 * size_of(box) || box.min()[across] > middle[across] ||
        box.max()[across] < middle[across])
      continue;
    for (const double plane : {box.min()[axis], box.max()[axis]}) {
      if (std::abs(plane - middle[axis]) > 0.1 * size[axis]) continue;
      const double cut = border_in_plane(garment, axis, plane, 1e-4 * size_of(box));
      if (cut < 0.5 * box.sizes().y()) continue;
      Ailment a{"half", "", "apply the mirror modifier where the garment was made"};
      a.text = "a border of " + geometry::length_text(cut) + " lies in the plane " + (axis == 0 ? "x" : "z") +
               " = " + three_digits(std::abs(plane) < 1e-9 ? 0 : plane) +
               " m, amid the body, and all of the garment on one side of it: this is half of a garment";
      return a;
    }
  }
  return std::nullopt;
}

/// "cm" for 100 and the like; "" if the ratio is that of no unit.
std::string unit_of(double ratio) {
  std::string unit;
  double nearest = std::log(8.0);
  for (const auto& [name, factor] : {std::pair("cm", 100.0), std::pair("mm", 1000.0)}) {
    const double off = std::abs(std::log(ratio / factor));
    if (off < nearest) nearest = off, unit = name;
  }
  return unit;
}

/// The box with z for y, and with y for z: how it lies if its file has another axis up.
std::pair<Eigen::AlignedBox3d, Eigen::AlignedBox3d> turned(const Eigen::AlignedBox3d& box) {
  Eigen::AlignedBox3d forwards, backwards;
  for (const Eigen::Vector3d& p : {box.min(), box.max()}) {
    forwards.extend(Eigen::Vector3d(p.x(), p.z(), -p.y()));
    backwards.extend(Eigen::Vector3d(p.x(), -p.z(), p.y()));
  }
  return {forwards, backwards};
}

/// Boxes that do not meet; and whether they would, if what is y in one file were z in the other.
void add_apart(const Eigen::AlignedBox3d& garment, const Eigen::AlignedBox3d& body,
               std::vector<Ailment>& found) {
  if (garment.isEmpty() || body.isEmpty() || garment.intersects(body)) return;
  Ailment a{"body_apart", "", "if they should touch, look at `unit`, `up` and their places"};
  a.text = "body and garment lie apart, their bounding boxes by " +
           three_digits(garment.exteriorDistance(body)) + " m";
  const auto [forwards, backwards] = turned(garment);
  const bool far = garment.exteriorDistance(body) > size_of(garment) / 2;
  if (far && (forwards.intersects(body) || backwards.intersects(body)))
    a.text += "; with y and z exchanged they meet: one of the files has z up, so bring both to one axis";
  found.push_back(std::move(a));
}

/// How far a box reaches out of another [m].
double beyond(const Eigen::AlignedBox3d& box, const Eigen::AlignedBox3d& of) {
  return std::max({0.0, (of.min() - box.min()).maxCoeff(), (box.max() - of.max()).maxCoeff()});
}

/// A garment that lies where its body stands, as their files have different axes up: its box agrees with the
/// body's once it is turned about x.
std::optional<Ailment> lying(const Eigen::AlignedBox3d& garment, const BodyOutline& body) {
  constexpr double far_out = 0.1, alike = 0.1;  // of the body's height
  constexpr double agrees = 0.25;               // of how far it reaches out as it is
  if (garment.isEmpty() || !body.figure) return std::nullopt;
  const Eigen::Vector3d size = body.box.sizes();
  const double out = beyond(garment, body.box);
  if (size.y() < 1.5 * size.z() || out < far_out * size.y()) return std::nullopt;
  const auto [forwards, backwards] = turned(garment);
  const double with_z_up = beyond(forwards, body.box), with_y_up = beyond(backwards, body.box);
  if (std::min(with_z_up, with_y_up) >= agrees * out) return std::nullopt;
  const bool z_up = with_z_up <= with_y_up + alike * size.y();
  const std::string its = z_up ? "z" : "y", of_body = z_up ? "y" : "z";
  Ailment a{"axes_differ", "", "export the garment with " + of_body + " up"};
  a.text =
      "the garment lies along z, where the body stands along y, and would be on the body if it stood: "
      "its file has " +
      its + " up, the body's has " + of_body + " up, and `up` turns both; " + a.help;
  a.fatal = true;
  return a;
}

}  // namespace

std::vector<Ailment> faults_of_pair(const Mesh& garment, const BodyOutline& body, bool unit_said) {
  std::vector<Ailment> found;
  if (const auto a = worn_on_itself(box_of(garment), body))
    found.push_back(*a);
  else if (const auto b = exchanged(garment, body))
    found.push_back(*b);
  else if (const auto c = body_as_garment(garment))
    found.push_back(*c);
  if (const auto a = lying(box_of(garment), body)) {
    found.push_back(*a);
  } else {
    if (const auto half = half_of_garment(garment, body)) found.push_back(*half);
    add_apart(box_of(garment), body.box, found);
  }
  const double cloth = size_of(box_of(garment)), wearer = size_of(body.box);
  if (unit_said || !(cloth > 0) || !(wearer > 0)) return found;
  const bool large_body = wearer > cloth;
  const double ratio = large_body ? wearer / cloth : cloth / wearer;
  const std::string unit = unit_of(ratio);
  if (ratio < odd_ratio || unit.empty()) return found;
  Ailment a{"two_units", "", large_body ? "`body_unit=" + unit + "`" : "`unit=" + unit + "` `body_unit=m`"};
  a.text = "the garment is " + three_digits(cloth) + " m from corner to corner, the body " +
           three_digits(wearer) + " m: their files seem to be in different units; say " + a.help +
           ", or `body_unit=m` if both are in metres";
  a.fatal = body.figure;  // floors and slabs may be large
  found.push_back(std::move(a));
  return found;
}

void heed(const std::vector<Ailment>& found, const std::string& name, const Context& context) {
  for (const Ailment& a : found)
    if (const std::string fault = name + ": " + a.text + (a.mendable ? "; " + a.help : "");
        a.fatal && !context.listener.allows(fault))
      throw geometry::ContentError(fault + "; `force` takes it as it is");
  for (const Ailment& a : found)
    if (!a.told_by_reader && !a.fatal)
      context.warn(a.code, name + ": " + a.text + (a.help.empty() ? "" : "; " + a.help), name, a.help);
}

}  // namespace furrow::jobs
