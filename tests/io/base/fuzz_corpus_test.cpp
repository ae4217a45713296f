// SPDX-License-Identifier: GPL-3.0-or-later
// What scripts/fuzz starts from, and what it once found, read without it.
#include <catch2/catch.hpp>
#include <filesystem>
#include <iterator>

#include "tests/fuzz/read_format.h"
#include "tests/test_paths.h"

using namespace furrow;
namespace fs = std::filesystem;

TEST_CASE(
    "fuzz corpus: each format has inputs, and its reader takes or refuses each of them and its halves") {
  for (const std::string& format : fuzz::formats()) {
    int inputs = 0, taken = 0;
    for (const auto& entry :
         fs::directory_iterator(fs::path(FURROW_SOURCE_DIR) / "tests/fuzz/corpus" / format)) {
      INFO(entry.path());
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(in), {}};
      taken += fuzz::reads(format, bytes);
      for (const std::size_t part : {2u, 3u, 5u}) {
        fuzz::reads(format, bytes.substr(0, bytes.size() / part));
        fuzz::reads(format, bytes.substr(bytes.size() / part));
      }
      ++inputs;
    }
    INFO(format);
    CHECK(inputs > 0);
    CHECK(taken > 0);
  }
}
