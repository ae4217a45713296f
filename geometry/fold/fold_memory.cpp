// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/fold_memory.h"

#include <algorithm>

#include "geometry/mesh/attribute_slots.h"
#include "geometry/mesh/vertex_attributes.h"

namespace furrow::geometry {
namespace {

constexpr std::size_t most_remembered = 8;  ///< some 6 MB each with thirty lines

class Bits {
 public:
  template <class Value>
  Bits& add(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    text.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  template <class List>
  Bits& add_all(const List& list) {
    add(std::size_t(std::size(list)));
    for (const auto& value : list) add(value);
    return *this;
  }
  std::string text;
};

template <class Key, class Elements>
void add_maps(const Mesh& mesh, const Elements& elements, Bits& bits) {
  AttributeMaps<Key>(mesh).for_each([&](const auto& attribute, const auto& map, const auto&) {
    bits.add_all(std::string(attribute.name));
    for (Key key : elements) bits.add(typename std::decay_t<decltype(attribute)>::Value(map[key]));
  });
}

void add_curve(const FoldCurve& curve, Bits& bits) {
  bits.add(curve.line).add(curve.closed).add(curve.begins_at_border).add(curve.ends_at_border);
  bits.add(curve.length).add(curve.sharpness).add(curve.set).add_all(curve.rise).add_all(curve.name);
  for (const Eigen::Vector3d& p : curve.points) bits.add(p.x()).add(p.y()).add(p.z());
  for (const FacePoint& p : curve.places) bits.add(p.face.idx()).add_all(p.barycentrics);
  bits.add_all(curve.arc).add_all(curve.width).add_all(curve.height).add_all(curve.cuts);
}

/// How many of the first clusters are those of a prefix that goes no farther; 0: it does, or others are.
std::size_t shared(const std::vector<std::string>& prefix, std::span<const std::string> clusters) {
  const bool begins =
      prefix.size() <= clusters.size() && std::equal(prefix.begin(), prefix.end(), clusters.begin());
  return begins ? prefix.size() : 0;
}

}  // namespace

std::string bits_of(const Mesh& mesh) {
  Bits bits;
  for (Vertex v : mesh.vertices())
    bits.add(mesh.point(v).x()).add(mesh.point(v).y()).add(mesh.point(v).z()).add(mesh.halfedge(v).idx());
  for (Halfedge h : mesh.halfedges())
    bits.add(mesh.target(h).idx()).add(mesh.next(h).idx()).add(mesh.face(h).idx());
  for (Face f : mesh.faces()) bits.add(mesh.halfedge(f).idx());
  add_maps<Vertex>(mesh, mesh.vertices(), bits);
  add_maps<Edge>(mesh, mesh.edges(), bits);
  add_maps<Halfedge>(mesh, mesh.halfedges(), bits);
  add_maps<Face>(mesh, mesh.faces(), bits);
  for (const VertexAttribute& a : vertex_attributes(mesh)) {
    bits.add_all(a.name);
    for (Vertex v : mesh.vertices()) bits.add(a.values[v]);
  }
  return std::move(bits.text);
}

std::string bits_of(const WrinkleOptions& o) {
  Bits bits;
  bits.add(o.detail).add(o.flat_base).add(o.fold_iterations).add(o.smoothing.lambda).add(o.smoothing.mu);
  bits.add(o.rest).add(o.first_line).add_all(o.held);
  return std::move(bits.text);
}

std::string bits_of(const FoldCluster& cluster, std::span<const Stroke> strokes, int first_line) {
  Bits bits;
  for (const FoldCurve& curve : cluster.curves) add_curve(curve, bits);
  for (int line : cluster.lines) {
    const Stroke& stroke = strokes[static_cast<std::size_t>(line - first_line)];
    bits.add(stroke.press).add(stroke.height);
  }
  return std::move(bits.text);
}

std::size_t FoldMemory::recall(const std::string& garment, std::span<const std::string> clusters,
                               FoldProgress& progress) {
  const std::lock_guard lock(mutex_);
  if (garment != garment_) prefixes_.clear();
  garment_ = garment;
  const auto longest =
      std::max_element(prefixes_.begin(), prefixes_.end(), [&](const Prefix& a, const Prefix& b) {
        return shared(a.clusters, clusters) < shared(b.clusters, clusters);
      });
  if (longest == prefixes_.end()) return 0;
  const std::size_t count = shared(longest->clusters, clusters);
  if (count == 0) return 0;
  prefixes_.splice(prefixes_.begin(), prefixes_, longest);
  progress = prefixes_.front().progress;
  return count;
}

void FoldMemory::remember(const std::string& garment, std::span<const std::string> clusters,
                          const FoldProgress& progress) {
  const std::lock_guard lock(mutex_);
  ++folded_;
  if (garment != garment_) prefixes_.clear();
  garment_ = garment;
  prefixes_.push_front({{clusters.begin(), clusters.end()}, progress});
  if (prefixes_.size() > most_remembered) prefixes_.pop_back();
}

std::size_t FoldMemory::folded() const {
  const std::lock_guard lock(mutex_);
  return folded_;
}

}  // namespace furrow::geometry
