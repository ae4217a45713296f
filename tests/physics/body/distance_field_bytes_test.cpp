// SPDX-License-Identifier: GPL-3.0-or-later
#include <rapidcheck.h>

#include <catch2/catch.hpp>

#include "physics/base/byte_block.h"
#include "physics/body/distance_field.h"
#include "tests/physics/body/field_inputs.h"

namespace {

using namespace furrow::physics;
using Bytes = std::vector<std::byte>;

DistanceField small_field(GradientRule gradient, int threads, int max_depth = 7) {
  DistanceFieldOptions options;
  options.tolerance = 3e-3;
  options.max_depth = max_depth;
  options.band_depth = max_depth - 2;
  options.gradient = gradient;
  options.threads = threads;
  TriangleMesh m = furrow::tests::sphere(12, 0.2);
  furrow::tests::append(m, furrow::tests::sphere(12, 0.15, {0.2, 0, 0}));  // signs need the winding number
  return DistanceField::build(m, options);
}

/// Puts the right checksum (FNV-1a) at the end of a changed block.
void seal(Bytes& block) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (std::size_t i = 0; i + 8 < block.size(); ++i)
    hash = (hash ^ static_cast<std::uint64_t>(block[i])) * 0x100000001b3ull;
  ByteWriter writer;
  writer.put(hash);
  const Bytes tail = writer.take();
  std::copy(tail.begin(), tail.end(), block.end() - 8);
}

}  // namespace

TEST_CASE("distance_field: a field goes through its bytes unchanged") {
  for (GradientRule rule : {GradientRule::exact_derivative, GradientRule::interpolated_corners}) {
    const DistanceField field = small_field(rule, 1);
    const Bytes bytes = field.to_bytes();
    const DistanceField back = DistanceField::from_bytes(bytes);
    CHECK(back.to_bytes() == bytes);
    CHECK(back.report().samples == field.report().samples);
    CHECK(back.report().sign.rule == field.report().sign.rule);
    std::mt19937_64 random(1);
    for (int i = 0; i < 1000; ++i) {
      Vec3 x;
      for (int k = 0; k < 3; ++k) x[k] = furrow::tests::uniform(random, -0.5, 0.5);
      REQUIRE(back.at(x).value == field.at(x).value);
      REQUIRE(back.at(x).gradient == field.at(x).gradient);
    }
  }
}

TEST_CASE("distance_field: a field has the same bits for one, two and three threads, and again", "[long]") {
  const Bytes one = small_field(GradientRule::exact_derivative, 1).to_bytes();
  CHECK(small_field(GradientRule::exact_derivative, 1).to_bytes() == one);
  CHECK(small_field(GradientRule::exact_derivative, 2).to_bytes() == one);
  CHECK(small_field(GradientRule::exact_derivative, 3).to_bytes() == one);
}

TEST_CASE("distance_field: cut and damaged blocks are refused") {
  const Bytes bytes = small_field(GradientRule::exact_derivative, 1, 5).to_bytes();
  CHECK_THROWS_AS(DistanceField::from_bytes({}), std::invalid_argument);
  CHECK(rc::check([&] {
    const std::size_t size = *rc::gen::inRange<std::size_t>(0, bytes.size());
    RC_ASSERT_THROWS_AS(DistanceField::from_bytes(std::span(bytes).first(size)), std::invalid_argument);
  }));
  Bytes other = bytes;
  other[bytes.size() / 2] ^= std::byte{4};
  CHECK_THROWS_WITH(DistanceField::from_bytes(other), Catch::Contains("checksum"));
}

TEST_CASE(
    "distance_field: blocks that contradict themselves are refused or harmless, even with a right checksum") {
  const Bytes bytes = small_field(GradientRule::exact_derivative, 1, 5).to_bytes();
  int refused = 0;
  CHECK(rc::check([&] {
    Bytes other = bytes;
    const std::size_t header = 400;  // mostly the fields and the tree, where a lie could do harm
    const std::size_t at =
        *rc::gen::inRange<std::size_t>(0, *rc::gen::arbitrary<bool>() ? header : bytes.size() / 4);
    other[at] = static_cast<std::byte>(*rc::gen::inRange(0, 256));
    seal(other);
    try {
      const DistanceField field = DistanceField::from_bytes(other);
      (void)field.at({0.1, 0.05, 0.1});
      RC_ASSERT(field.to_bytes() == other);
    } catch (const std::invalid_argument&) {
      ++refused;
    }
  }));
  CHECK(refused > 20);
}
