// SPDX-License-Identifier: GPL-3.0-or-later
#include <bit>
#include <cstdint>

#include "bridge/arrays/convert.h"
#include "io/animation/animation_encoder.h"
#include "io/base/byte_order.h"
#include "io/base/own_mark.h"
#include "io/mesh/file_frame.h"

namespace furrow::io {
namespace {

/// What PC2 and MDD share: a frame is x y z of each vertex, in single precision.
class PointCacheEncoder : public AnimationEncoder {
 public:
  PointCacheEncoder(const geometry::Mesh& mesh, const AnimationOptions& options, std::endian order)
      : options_(options), vertices_(static_cast<std::int32_t>(mesh.number_of_vertices())), order_(order) {}

  std::string frame(std::size_t, std::span<const physics::Vec3> positions) override {
    std::string bytes;
    bytes.reserve(12 * positions.size());
    for (const physics::Vec3& x : positions) {
      const geometry::Vector p = to_file(bridge::to_cgal(x), options_.frame);
      for (int k = 0; k < 3; ++k) put(bytes, static_cast<float>(p[k]));
    }
    return bytes;
  }

  std::string tail(std::size_t) const override { return std::string(own_tail); }

 protected:
  template <class T>
  void put(std::string& bytes, T value) const {
    append_in_order(bytes, value, order_);
  }

  AnimationOptions options_;
  std::int32_t vertices_;

 private:
  std::endian order_;
};

/// The format by its author: http://www.footools.com/plugins/docs/PointCache2_README.html
class Pc2Encoder : public PointCacheEncoder {
 public:
  Pc2Encoder(const geometry::Mesh& mesh, const AnimationOptions& options)
      : PointCacheEncoder(mesh, options, std::endian::little) {}

  std::string head(std::size_t frames) const override {
    std::string bytes("POINTCACHE2\0", 12);
    put(bytes, std::int32_t{1});  // version
    put(bytes, vertices_);
    put(bytes, static_cast<float>(options_.start * options_.fps));  // first frame
    put(bytes, 1.0f);                                               // frames a sample
    put(bytes, static_cast<std::int32_t>(frames));
    return bytes;
  }
};

class MddEncoder : public PointCacheEncoder {
 public:
  MddEncoder(const geometry::Mesh& mesh, const AnimationOptions& options)
      : PointCacheEncoder(mesh, options, std::endian::big) {}

  std::string head(std::size_t frames) const override {
    std::string bytes;
    put(bytes, static_cast<std::int32_t>(frames));
    put(bytes, vertices_);
    for (std::size_t i = 0; i < frames; ++i) put(bytes, static_cast<float>(frame_time(options_, i)));
    return bytes;
  }
};

}  // namespace

std::unique_ptr<AnimationEncoder> pc2_encoder(const geometry::Mesh& mesh, const AnimationOptions& options) {
  return std::make_unique<Pc2Encoder>(mesh, options);
}

std::unique_ptr<AnimationEncoder> mdd_encoder(const geometry::Mesh& mesh, const AnimationOptions& options) {
  return std::make_unique<MddEncoder>(mesh, options);
}

}  // namespace furrow::io
