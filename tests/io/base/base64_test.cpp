// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/base64.h"

#include <catch2/catch.hpp>

#include "geometry/mesh/errors.h"

using namespace furrow;

namespace {

std::string encoded(const std::string& text) {
  return io::to_base64(std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace

TEST_CASE("base64: the standard's examples, there and back") {  // RFC 4648, section 10
  for (const auto& [text, letters] :
       {std::pair("", ""), {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}}) {
    CHECK(encoded(text) == letters);
    CHECK(io::from_base64(letters) == text);
  }
  std::string all;
  for (int c = 0; c < 256; ++c) all += static_cast<char>(c);
  CHECK(io::from_base64(encoded(all)) == all);
  CHECK(io::from_base64("Zg") == "f");
  CHECK_THROWS_AS(io::from_base64("Zm 9v"), geometry::ContentError);
}
