// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/share_file.h"

#include <sys/stat.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <stdexcept>
#include <thread>

#include "io/base/atomic_file.h"
#include "io/base/outputs_below.h"
#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::tests;

namespace {

/// Wants a file that holds "seven".
struct Wanted {
  std::filesystem::path path;
  std::string value = {};
  int makings = 0;

  io::ShareReport share(const std::function<void()>& wait = [] {}) {
    const auto read = [&] {
      if (slurp(path) != "seven") throw std::invalid_argument("it says " + slurp(path));
      value = "seven, read";
    };
    const auto make = [&] {
      ++makings;
      value = "seven, made";
    };
    const auto write = [&] { io::write_atomically(path, [](std::ostream& out) { out << "seven"; }); };
    return io::share_file(path, {read, make, write, wait});
  }
};

}  // namespace

TEST_CASE("share_file: the first makes it, the next reads it, and one that cannot be used is made again") {
  TemporaryFolder folder;
  Wanted wanted{folder / "new/file"};
  CHECK(wanted.share().made);
  CHECK(wanted.value == "seven, made");
  CHECK_FALSE(wanted.share().made);
  CHECK(wanted.value == "seven, read");
  spit(wanted.path, "eight");
  const io::ShareReport report = wanted.share();
  CHECK(report.made);
  CHECK(report.broken == "it says eight");
  CHECK(report.unwritten.empty());
  CHECK(slurp(wanted.path) == "seven");
  CHECK(wanted.makings == 2);
}

TEST_CASE("share_file: where nothing can be written it is made all the same, and that is told") {
  TemporaryFolder folder;
  spit(folder / "a file", "");
  Wanted wanted{folder / "a file" / "file"};
  const io::ShareReport report = wanted.share();
  CHECK(report.made);
  CHECK_FALSE(report.unwritten.empty());
  CHECK(wanted.value == "seven, made");
}

TEST_CASE("share_file: a link is neither read nor written through, and a pipe holds nobody up") {
  TemporaryFolder folder, outside;
  spit(outside / "mine", "seven");
  Wanted linked{folder / "linked"}, piped{folder / "piped"};
  std::filesystem::create_symlink(outside / "mine", linked.path);
  std::filesystem::create_symlink(outside / "lock", folder / "linked.lock");
  REQUIRE(mkfifo(piped.path.c_str(), 0600) == 0);
  REQUIRE(mkfifo((folder / "piped.lock").c_str(), 0600) == 0);
  for (Wanted* wanted : {&linked, &piped}) {
    const io::ShareReport report = wanted->share();
    CHECK(report.made);
    CHECK_FALSE(report.broken.empty());
    CHECK_FALSE(report.unwritten.empty());
    CHECK(wanted->value == "seven, made");
  }
  CHECK(slurp(outside / "mine") == "seven");
  CHECK_FALSE(std::filesystem::exists(outside / "lock"));
}

TEST_CASE("share_file: where outputs are kept below a folder nothing is made outside of it") {
  TemporaryFolder folder, outside;
  const io::OutputsBelow below(folder.path());
  Wanted far{outside / "new/file"}, near{folder / "new/file"};
  const io::ShareReport report = far.share();
  CHECK(report.made);
  CHECK(report.unwritten.find("outside") != std::string::npos);
  CHECK(far.value == "seven, made");
  CHECK_FALSE(std::filesystem::exists(outside / "new"));
  CHECK(near.share().unwritten.empty());
  CHECK_FALSE(near.share().made);
}

TEST_CASE("share_file: it is there at once for others, also where outputs wait to appear together") {
  TemporaryFolder folder;
  const io::OutputGroup group;
  Wanted wanted{folder / "file"};
  wanted.share();
  CHECK(slurp(wanted.path) == "seven");
}

TEST_CASE("share_file: one makes it while others wait, who may give up") {
  TemporaryFolder folder;
  const std::filesystem::path path = folder / "file";
  std::atomic<bool> begun = false, may_end = false;
  std::thread maker([&] {
    io::share_file(path, {[] {},
                          [&] {
                            begun = true;
                            while (!may_end) std::this_thread::yield();
                          },
                          [&] { spit(path, "seven"); }, [] {}});
  });
  while (!begun) std::this_thread::yield();
  Wanted impatient{path}, patient{path};
  CHECK_THROWS_AS(impatient.share([] { throw std::runtime_error("given up"); }), std::runtime_error);
  int asked = 0;
  patient.share([&] { may_end = ++asked > 2; });
  maker.join();
  CHECK(asked > 2);
  CHECK(patient.value == "seven, read");
  CHECK(impatient.makings + patient.makings == 0);
}
