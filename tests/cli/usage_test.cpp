// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "io/base/field_words.h"
#include "io/scene/settings_schema.h"
#include "run_furrow.h"

using namespace furrow::tests;

namespace {
const char* const square_obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
}

TEST_CASE("usage: every subcommand has help with units, and help succeeds") {
  const std::string all = run_furrow("--help").out;
  const std::regex line("\n  ([a-z]+) +[A-Z]");
  std::set<std::string> subs;
  for (std::sregex_iterator at(all.begin(), all.end(), line), end; at != end; ++at) subs.insert((*at)[1]);
  CHECK(subs.size() >= 22);
  for (const char* without_report : {"studio", "batch", "completion", "man"})
    CHECK(subs.erase(without_report));
  for (const std::string& sub : subs) {
    const Run run = run_furrow(sub + " --help");
    INFO(sub);
    CHECK(run.exit_code == 0);
    CHECK(run.out.find("--json") != std::string::npos);
    CHECK(run.err.empty());
  }
  CHECK(run_furrow("simulate --help-all").out.find("[N/m]") != std::string::npos);
}

TEST_CASE("usage: --help shows at most thirty options in groups, --help-all those and the rarer ones") {
  const auto options_of = [](const std::string& call) {
    const std::string help = run_furrow(call).out;
    std::set<std::string> options;
    const std::regex line("\n +(?:-\\w,)?(?:\\w+,)?(--[a-z-]+)");
    for (std::sregex_iterator at(help.begin(), help.end(), line), end; at != end; ++at)
      options.insert((*at)[1]);
    return options;
  };
  for (const std::string sub : {"drape", "wrinkle", "simulate", "keep"}) {
    INFO(sub);
    const std::set<std::string> few = options_of(sub + " --help"), all = options_of(sub + " --help-all");
    CHECK(few.size() <= 30);
    CHECK(few.count("--output") + few.count("--body") + few.count("--fabric") == 3);
    CHECK(std::includes(all.begin(), all.end(), few.begin(), few.end()));
    const std::string rarer = std::to_string(all.size() - few.size()) + " rarer options: furrow " + sub;
    CHECK(run_furrow(sub + " --help").out.find(rarer + " --help-all\n") != std::string::npos);
    CHECK(run_furrow(sub + " --help").out.find("\nBody and pins:\n") != std::string::npos);
  }
  CHECK(options_of("info --help") == options_of("info --help-all"));
}

TEST_CASE("usage: the help of each subcommand has the flags that the schema of settings gives it") {
  namespace used_by = furrow::io::used_by;
  const auto flag_name = [](const furrow::io::Setting& s) { return furrow::io::flag_of(s.keyword); };
  for (const auto& [sub, bit] : {std::pair("simulate", used_by::simulate),
                                 {"keep", used_by::keep},
                                 {"drape", used_by::drape},
                                 {"wrinkle", used_by::wrinkle}}) {
    const std::string help = run_furrow(std::string(sub) + " --help-all").out;
    for (const furrow::io::Setting& s : furrow::io::scene_settings()) {
      if (s.keyword.empty() || (bit == used_by::wrinkle && s.keyword == "density"))
        continue;  // its own option
      const std::string words = furrow::io::described(s, flag_name);
      INFO(sub << " " << s.keyword << ": " << words);
      const bool is_there = help.find(words) != std::string::npos;
      const bool is_common = s.flag_in == used_by::nobody;  // with words of its own
      CHECK((is_common || is_there == ((s.flag_in & bit) != 0)));
      if (is_common || is_there) CHECK(help.find(flag_name(s)) != std::string::npos);
    }
  }
}

TEST_CASE("usage: the version names the libraries") {
  const Run run = run_furrow("--version");
  CHECK(run.exit_code == 0);
  for (const char* library : {"furrow", "CGAL", "Eigen", "Embree", "assimp"})
    CHECK(run.out.find(library) != std::string::npos);
}

TEST_CASE("usage: a wrong call exits with 2 and one line that begins with error:") {
  const ScratchDirectory scratch;
  write_text(scratch / "square.obj", square_obj);
  const std::string square = scratch / "square.obj";
  for (const std::string& call :
       {std::string("wrinkel a b"), std::string("help wrinkel"), std::string("info"),
        "info " + square + " --unit mile", "subdivide " + square + " -o " + (scratch / "o.obj"),
        "subdivide " + square + " --subdivide 1 --all -o " + (scratch / "o.obj"),
        "smooth " + square + " -o " + (scratch / "o.obj") + " --lambda 2",
        "simulate " + square + " -o " + (scratch / "o.obj") + " --pin-loop middle",
        "simulate " + square + " -o " + (scratch / "o.obj") + " --pin-vertices 99",
        "simulate " + square + " -o " + (scratch / "o.obj") + " --seconds -1",
        "simulate " + square + " -o " + (scratch / "o.obj") + " --dt 1"}) {
    INFO("furrow " << call);
    const Run run = run_furrow(call);
    CHECK(run.exit_code == 2);
    CHECK(run.err.rfind("error: ", 0) == 0);
    CHECK(run.out.empty());
    CHECK_FALSE(std::filesystem::exists(scratch / "o.obj"));
  }
  CHECK(run_furrow("wrinkel a b").err.find("did you mean 'wrinkle'") != std::string::npos);
}

TEST_CASE("usage: furrow alone and furrow help print the help, furrow help NAME that of a subcommand") {
  const Run help = run_furrow("--help");
  REQUIRE(help.exit_code == 0);
  CHECK(run_furrow("").out == help.out);
  CHECK(run_furrow("").exit_code == 0);
  CHECK(run_furrow("help").out == help.out);
  CHECK(run_furrow("help drape").out == run_furrow("drape --help").out);
  CHECK(run_furrow("-V").out == run_furrow("--version").out);
}

TEST_CASE("usage: an option that is not known is named, with the nearest one") {
  const Run near = run_furrow("simulate a.obj --secnds 1 -o b.ply");
  CHECK(near.exit_code == 2);
  CHECK(near.err == "error: --secnds: furrow simulate has no such option; did you mean --seconds?\n");
  const Run far = run_furrow("simulate a.obj --beautiful=1");
  CHECK(far.err ==
        "error: --beautiful: furrow simulate has no such option; furrow simulate --help tells more\n");
  const Run word = run_furrow("info a.obj b.obj");
  CHECK(word.err == "error: b.obj: furrow info takes no further argument; furrow info --help tells more\n");
}

TEST_CASE("usage: without a terminal progress is told in lines") {
  const ScratchDirectory scratch;
  write_text(scratch / "square.obj", square_obj);
  const std::string call = "simulate --pin-vertices 0 --dt 1e-5 --seconds 0.3 " + (scratch / "square.obj") +
                           " -o " + (scratch / "o.ply");
  CHECK(run_furrow(call + " --progress none").err.empty());
  CHECK(run_furrow(call + " --progress 1e-6 -q").err.empty());
  const Run run = run_furrow(call + " --progress 1e-6");
  REQUIRE(run.exit_code == 0);
  CHECK(run.err.rfind("simulating: ", 0) == 0);
  CHECK(run.err.find(" %, ") != std::string::npos);
  CHECK(run.err.find('\r') == std::string::npos);
  CHECK(run_furrow(call + " --progress much").exit_code == 2);
}

TEST_CASE("usage: a file that cannot be read exits with 3") {
  CHECK(run_furrow("info /nonexistent/shirt.obj").exit_code == 3);
  const ScratchDirectory scratch;
  write_text(scratch / "bad.obj", "v 0 0 0\nv 1 0 zero\n");
  const Run run = run_furrow("info " + (scratch / "bad.obj"));
  CHECK(run.exit_code == 3);
  CHECK(run.err.find("bad.obj:2") != std::string::npos);
}

TEST_CASE("usage: a file that cannot be written exits with 1 and leaves nothing behind") {
  const ScratchDirectory scratch;
  write_text(scratch / "square.obj", square_obj);
  const Run run =
      run_furrow("smooth " + (scratch / "square.obj") + " -o " + (scratch / "no/such/folder.obj"));
  CHECK(run.exit_code == 1);
  CHECK(run.err.rfind("error: ", 0) == 0);
}

TEST_CASE("usage: info counts a square and says it as JSON") {
  const ScratchDirectory scratch;
  write_text(scratch / "square.obj", square_obj);
  const Run run = run_furrow("info --json " + (scratch / "square.obj"));
  REQUIRE(run.exit_code == 0);
  const auto report = nlohmann::json::parse(run.out);
  CHECK(report["schema"] == 1);
  CHECK(report["vertices"] == 4);
  CHECK(report["edges"] == 5);
  CHECK(report["faces"] == 2);
  CHECK(report["boundary_loops"] == 1);
  CHECK(report["euler_characteristic"] == 1);
  CHECK(report["closed"] == false);
  CHECK(report["area"].get<double>() == Approx(1));
  CHECK(report["repairs"]["triangulated_faces"] == 1);
}

TEST_CASE("usage: units and the up axis turn what is read and turn it back when written") {
  const ScratchDirectory scratch;
  write_text(scratch / "square.obj", square_obj);
  const Run run = run_furrow("info --json --unit cm " + (scratch / "square.obj"));
  CHECK(nlohmann::json::parse(run.out)["area"].get<double>() == Approx(1e-4));
  const Run tall = run_furrow("wrinkle --unit m " + (scratch / "square.obj") + " " + (scratch / "none.json") +
                              " -o " + (scratch / "o.ply"));
  CHECK(tall.exit_code == 3);
  REQUIRE(run_furrow("smooth --iterations 0 --up z --unit mm " + (scratch / "square.obj") + " -o " +
                     (scratch / "same.obj"))
              .exit_code == 0);
  const auto same = nlohmann::json::parse(run_furrow("info --json " + (scratch / "same.obj")).out);
  CHECK(same["bounding_box"]["max"] == nlohmann::json::parse("[1.0, 1.0, 0.0]"));
}

TEST_CASE("usage: a garment taller than 10 m is refused with a hint at the unit") {
  const ScratchDirectory scratch;
  write_text(scratch / "tall.obj", "v 0 0 0\nv 1 0 0\nv 1 170 0\nf 1 2 3\n");
  const Run run = run_furrow("simulate " + (scratch / "tall.obj") + " -o " + (scratch / "o.obj"));
  CHECK(run.exit_code == 3);
  CHECK(run.err.find("--unit cm") != std::string::npos);
}
