// SPDX-License-Identifier: MIT
#include <cmath>
#include <stdexcept>

#include "physics/base/byte_block.h"
#include "physics/body/distance_field.h"

namespace furrow::physics {
namespace {

constexpr std::uint64_t magic = 0x444c454946525546;  // "FURFIELD"
constexpr std::uint32_t version = 1;

void require_bytes(bool good, const char* what) {
  if (!good) throw std::invalid_argument(std::string("DistanceField::from_bytes: ") + what);
}

std::uint64_t checksum(std::span<const std::byte> bytes) {  // FNV-1a
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (std::byte b : bytes) hash = (hash ^ static_cast<std::uint64_t>(b)) * 0x100000001b3ull;
  return hash;
}

/// The one list of fixed fields, for both directions: visit(field) is called for each in the block's order.
template <class Report, class Visit>
void visit_report(Report& r, const Visit& visit) {
  visit(r.tolerance), visit(r.leaves), visit(r.samples), visit(r.depth), visit(r.leaves_at_max_depth);
  visit(r.largest_repair), visit(r.sign.border_edges), visit(r.sign.irregular_edges);
  visit(r.sign.crossed_triangles), visit(r.sign.dropped_triangles), visit(r.sign.samples);
  visit(r.sign.disagreement), visit(r.sign.signed_volume);
}

}  // namespace

/// Nodes and leaves each met exactly once, in order, from the root, and no leaf below max_depth.
struct DistanceField::TreeCheck {
  std::span<const std::array<Entry, 8>> nodes;
  int max_depth;
  Entry next_node = 1, next_leaf = 0;

  void visit(Entry node, int level) {
    for (Entry entry : nodes[node]) {
      require_bytes(level < max_depth, "the tree is deeper than it says");
      if (entry & leaf_bit) {
        require_bytes((entry & ~leaf_bit) == next_leaf++, "a leaf is out of order");
        continue;
      }
      require_bytes(entry == next_node && entry < nodes.size(), "a node is out of order");
      ++next_node;
      visit(entry, level + 1);
    }
  }
};

std::vector<std::byte> DistanceField::to_bytes() const {
  ByteWriter out;
  const auto put = [&](auto value) { out.put(value); };
  put(magic), put(version), put(static_cast<std::uint32_t>(max_depth_));
  put(static_cast<std::uint32_t>(gradient_ == GradientRule::interpolated_corners));
  put(static_cast<std::uint32_t>(report_.sign.rule)), put(static_cast<std::uint32_t>(report_.sign.closed));
  put(low_[0]), put(low_[1]), put(low_[2]), put(size_), put(outer_band_), put(inner_band_), put(far_slope_);
  visit_report(report_, put);
  put(static_cast<std::uint64_t>(nodes_.size())), put(static_cast<std::uint64_t>(leaves_.size()));
  for (const auto& node : nodes_)
    for (Entry entry : node) put(entry);
  for (const Leaf& leaf : leaves_)
    for (float value : leaf) put(value);
  for (const LeafGradient& leaf : leaf_gradients_)
    for (const auto& corner : leaf)
      for (float value : corner) put(value);
  std::vector<std::byte> block = out.take();
  ByteWriter end;
  end.put(checksum(block));
  const std::vector<std::byte> tail = end.take();
  block.insert(block.end(), tail.begin(), tail.end());
  return block;
}

DistanceField DistanceField::from_bytes(std::span<const std::byte> bytes) {
  require_bytes(bytes.size() >= 12, "the block is cut");
  ByteReader in(bytes);
  require_bytes(in.get<std::uint64_t>() == magic, "this is no distance field");
  require_bytes(in.get<std::uint32_t>() == version, "this version is not known");
  require_bytes(bytes.size() >= 20 &&
                    ByteReader(bytes.last(8)).get<std::uint64_t>() == checksum(bytes.first(bytes.size() - 8)),
                "the block is cut or damaged (checksum)");
  DistanceField field;
  const auto word = [&](std::uint32_t below) {
    const auto value = in.get<std::uint32_t>();
    require_bytes(value < below, "a field is out of its range");
    return value;
  };
  const auto get = [&](auto& value) { value = in.get<std::remove_reference_t<decltype(value)>>(); };
  const auto finite = [&](double& value) {
    get(value);
    require_bytes(std::isfinite(value), "a number is not finite");
  };
  field.max_depth_ = static_cast<int>(word(13));
  require_bytes(field.max_depth_ >= 3, "a field is out of its range");
  field.gradient_ = word(2) ? GradientRule::interpolated_corners : GradientRule::exact_derivative;
  field.report_.sign.rule = static_cast<SignRule>(word(3));
  field.report_.sign.closed = word(2) != 0;
  for (double* value : {&field.low_[0], &field.low_[1], &field.low_[2], &field.size_, &field.outer_band_,
                        &field.inner_band_, &field.far_slope_})
    finite(*value);
  require_bytes(field.size_ > 0, "the cube has no size");
  visit_report(field.report_, get);
  require_bytes(field.report_.tolerance > 0, "the tolerance is not positive");
  field.read_tree(in);
  field.index();
  return field;
}

void DistanceField::read_tree(ByteReader& in) {
  const auto node_count = in.get<std::uint64_t>(), leaf_count = in.get<std::uint64_t>();
  const bool with_gradients = gradient_ == GradientRule::interpolated_corners;
  const std::size_t leaf_size = sizeof(Leaf) + (with_gradients ? sizeof(LeafGradient) : 0);
  require_bytes(in.left() >= sizeof(std::uint64_t), "the block is cut");
  const std::size_t left = in.left() - sizeof(std::uint64_t);  // the checksum stands last
  require_bytes(node_count > 0 && node_count <= left / 32 && leaf_count <= left / 32 &&
                    leaf_count <= index_mask && node_count * 32 + leaf_count * leaf_size == left,
                "the counts do not fit the block");
  nodes_.resize(node_count);
  for (auto& node : nodes_)
    for (Entry& entry : node) entry = in.get<Entry>();
  TreeCheck check{nodes_, max_depth_};
  check.visit(0, 0);
  require_bytes(check.next_node == node_count && check.next_leaf == leaf_count,
                "the tree does not reach every leaf");
  const auto number = [&](float& value) {
    value = in.get<float>();
    require_bytes(std::isfinite(value), "a number is not finite");
  };
  leaves_.resize(leaf_count);
  for (Leaf& leaf : leaves_)
    for (float& value : leaf) number(value);
  if (with_gradients) leaf_gradients_.resize(leaf_count);
  for (LeafGradient& leaf : leaf_gradients_)
    for (auto& corner : leaf)
      for (float& value : corner) number(value);
}

}  // namespace furrow::physics
