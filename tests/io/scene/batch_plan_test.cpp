// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/batch_plan.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "io/base/bytes_file.h"
#include "io/scene/csv.h"
#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::tests;

namespace {

using Words = std::vector<std::string>;

/// A folder with a few files of its own, gone at the end.
class PlanFolder {
 public:
  explicit PlanFolder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("furrow_plan_" + name + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
    for (const char* file : {"shirt-M.obj", "shirt-L.obj", "anna.obj"}) write(file, file);
  }
  ~PlanFolder() { std::filesystem::remove_all(path_); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }
  io::BatchPlan read(const std::string& text, const std::string& version = "1") const {
    write("plan.toml", text);
    return io::read_batch_plan(path_ / "plan.toml", version);
  }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

const char* const sizes = R"(
title = "Sizes"
output = "fits"
[options]
body = "anna.obj"
subdivide = 0
self-contact = "on"
no-legend = true
[cases]
garment = ["shirt-{size}.obj"]
fabric = ["cotton", "silk"]
size = ["M", "L"]
)";

}  // namespace

TEST_CASE("batch_plan: a plan tries each with each, fills in braces, and names files by absolute paths") {
  const PlanFolder folder("each");
  const io::BatchPlan plan = folder.read(sizes);
  CHECK(plan.title == "Sizes");
  CHECK(plan.command == "drape");
  CHECK(plan.output == std::filesystem::path(folder / "fits"));
  REQUIRE(plan.cases.size() == 4);
  CHECK(plan.cases[1].arguments == Words{"drape", folder / "shirt-L.obj", "--body", folder / "anna.obj",
                                         "--no-legend", "--self-contact", "on", "--subdivide", "0",
                                         "--fabric", "cotton"});
  CHECK(plan.columns == Words{"fabric", "size"});
  for (const io::BatchCase& one : plan.cases) CHECK(one.name.size() == 16);
  CHECK(plan.cases[0].has_body);
}

TEST_CASE(
    "batch_plan: a case's name follows what its files hold, its options and the version, not where it lies") {
  const PlanFolder here("here"), there("there");
  const io::BatchPlan a = here.read(sizes), b = there.read(sizes);
  for (std::size_t i = 0; i < a.cases.size(); ++i) CHECK(a.cases[i].name == b.cases[i].name);
  CHECK(here.read(sizes, "2").cases[0].name != a.cases[0].name);
  there.write("shirt-L.obj", "another");
  const io::BatchPlan changed = there.read(sizes);
  CHECK(changed.cases[0].name == a.cases[0].name);  // M
  CHECK(changed.cases[1].name != a.cases[1].name);  // L
  there.write("shirt-L.obj", "shirt-M.obj");        // the same as M
  const io::BatchPlan same = there.read(sizes);
  CHECK(same.cases.size() == 2);
  CHECK(same.repeated == 2);
}

TEST_CASE("batch_plan: a cache is a folder beside the plan, and no case depends on it") {
  const PlanFolder folder("cache");
  std::string text = sizes;
  const std::string name = folder.read(text).cases[0].name;
  text.replace(text.find("[cases]"), 0, "cache = \"../kept\"\n");
  const io::BatchCase one = folder.read(text).cases[0];
  CHECK(one.name == name);
  const std::string kept = std::filesystem::path(folder / "../kept").lexically_normal().string();
  const auto at = std::find(one.arguments.begin(), one.arguments.end(), "--cache");
  REQUIRE(one.arguments.end() - at > 1);
  CHECK(at[1] == kept);
}

TEST_CASE("batch_plan: cases come from a table in commas, too") {
  const PlanFolder folder("csv");
  folder.write(
      "cases.csv",
      "garment,fabric,no-legend,band\nshirt-M.obj,cotton,true,\n\nshirt-L.obj,\"silk\",false,top=0.9\n");
  const io::BatchPlan plan = folder.read("cases = \"cases.csv\"\n[options]\nbody = \"anna.obj\"\n");
  REQUIRE(plan.cases.size() == 2);
  CHECK(plan.cases[0].arguments == Words{"drape", folder / "shirt-M.obj", "--body", folder / "anna.obj",
                                         "--fabric", "cotton", "--no-legend"});
  CHECK(plan.cases[1].arguments == Words{"drape", folder / "shirt-L.obj", "--body", folder / "anna.obj",
                                         "--fabric", "silk", "--band", "top=0.9"});
  CHECK(plan.columns == Words{"garment", "fabric", "no-legend", "band"});
  CHECK(plan.output == std::filesystem::path(folder / "plan-results"));
}

TEST_CASE("batch_plan: several garments are one case, worn over each other") {
  const PlanFolder folder("layers");
  const io::BatchPlan plan = folder.read(
      "[cases]\ngarment = [[\"shirt-M.obj\", \"shirt-L.obj\"], \"shirt-M.obj\"]\nbody = [\"anna.obj\"]\n");
  REQUIRE(plan.cases.size() == 2);
  CHECK(plan.cases[0].arguments ==
        Words{"drape", folder / "shirt-M.obj", folder / "shirt-L.obj", "--body", folder / "anna.obj"});
}

TEST_CASE("batch_plan: a fault is told with its place and what to do") {
  const PlanFolder folder("faults");
  const std::string cases = "[cases]\ngarment = [\"shirt-M.obj\"]\n";
  const auto told = [&](const std::string& text, const std::string& place, const std::string& words) {
    const std::string error = content_error([&] { folder.read(text); });
    INFO(error);
    CHECK(error.find(place) != std::string::npos);
    CHECK(error.find(words) != std::string::npos);
  };
  told("titel = \"x\"\n" + cases, "plan.toml:1:1", "did you mean 'title'?");
  told("command = \"info\"\n" + cases, "plan.toml:1:1", "must be drape, simulate, keep, wrinkle or fit");
  told("title = \"x\"\n", "plan.toml", "there is no [cases]");
  told("[cases]\ngarment = [\"coat.obj\"]\n", "plan.toml", "there is no file " + (folder / "coat.obj"));
  told("[cases]\ngarment = \"shirt-M.obj\"\n", "plan.toml:2:1", "must be a list of what to try");
  told("[cases]\nfabric = [\"silk\"]\n", "plan.toml", "a case has no garment");
  told("[options]\noutput = \"x.ply\"\n" + cases, "output", "a batch names that of each case by itself");
  told("mesh = \"\"\npicture = false\n" + cases, "plan.toml", "neither a mesh nor a picture");
  told("cases = \"no.csv\"\n", "no.csv", "");
  const std::string control = "has a control character, such as a line end; write it without";
  for (const std::string& text :
       {"title = \"a\\nb\"\n" + cases, "output = \"a\\nb\"\n" + cases, "report = [\"a\\tb\"]\n" + cases,
        "[options]\nfabric = \"silk\\ntouch x; : \"\n" + cases, "[options]\n\"a\\nb\" = true\n" + cases,
        std::string("[cases]\ngarment = [\"shirt-M.obj\"]\nfabric = [\"silk\", \"\\u001b[2J\"]\n")})
    told(text, "plan.toml", control);
  folder.write("lines.csv", "garment,fabric\nshirt-M.obj,\"silk\ntouch x; : \"\n");
  told("cases = \"lines.csv\"\n", "lines.csv: case 1: \"silk\\ntouch x; : \"", control);
  folder.write("a\nb.obj", "");
  told("[cases]\ngarment = [\"a\\nb.obj\"]\n", "plan.toml:2", control);
  told("[options]\nfabric = \"--output=x.ply\"\n" + cases, "fabric", "is an option and no value");
  CHECK(folder.read("[options]\nheight = \"-.5\"\n" + cases).cases.size() == 1);
}

TEST_CASE("csv: fields in quotes hold commas, line ends and quotes") {
  using Rows = std::vector<Words>;
  CHECK(io::parse_csv("a,b\r\n\"x,1\",\"say \"\"no\"\"\n\"\r\n,\n", "t") ==
        Rows{{"a", "b"}, {"x,1", "say \"no\"\n"}, {"", ""}});
  CHECK(io::parse_csv("\xef\xbb\xbfone", "t") == Rows{{"one"}});
  CHECK(content_error([] { io::parse_csv("a,b\n1\n", "t"); }) == "t:2: 1 fields where the heading has 2");
  CHECK(content_error([] { io::parse_csv("a\n\"x\n", "t"); }) == "t:2: a quote is not closed");
  CHECK(content_error([] { io::parse_csv("\"x\"y\n", "t"); }) == "t:1: there is text behind a closed quote");
}
