// SPDX-License-Identifier: GPL-3.0-or-later
// furrow batch: cases of a plan as lines, on one machine and by Slurm's scripts.
#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/base/run_program.h"
#include "run_furrow.h"

using namespace furrow::tests;
using furrow::io::run_program;
using nlohmann::json;

namespace {

const char* const square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

/// A plan of cloths that fall for a moment, one of them from a file that is no mesh.
struct Batch {
  ScratchDirectory folder;
  std::string plan = folder / "plan.toml";

  Batch() {
    write_text(folder / "a cloth.obj", square);
    write_text(folder / "b.obj", std::string(square) + "v 2 2 0\nf 2 5 3\n");
    write_text(folder / "broken.obj", "v 0 0\n");
    write_text(plan,
               "title = \"Cloths <fall> & rest\"\ncommand = \"simulate\"\noutput = \"out\"\nreport = "
               "[\"outcome\", \"steps\"]\n"
               "[options]\nseconds = 0.02\n[cases]\ngarment = [\"a cloth.obj\", \"b.obj\", \"broken.obj\"]\n"
               "fabric = [\"cotton\", \"silk\"]\n");
  }
  Run furrow(const std::string& words) const { return run_furrow("batch " + words); }
  std::vector<std::string> lines() const {
    std::istringstream out(furrow("list " + plan).out);
    std::vector<std::string> all;
    for (std::string line; std::getline(out, line);) all.push_back(line);
    return all;
  }
  std::vector<json> rows() const {
    std::istringstream in(read_text(folder / "out/results.jsonl"));
    std::vector<json> all;
    for (std::string line; std::getline(in, line);) all.push_back(json::parse(line));
    return all;
  }
};

int run_line(const std::string& line) { return run_program("sh", {"-c", line}).exit_code; }

/// Rows without what differs from run to run.
std::vector<json> lasting(std::vector<json> rows) {
  for (json& row : rows) {
    for (const char* key : {"seconds", "processor_seconds", "peak_bytes", "host", "job"}) row.erase(key);
    if (row.contains("report") && row["report"].is_object())
      for (const char* key : {"seconds", "times"}) row["report"].erase(key);
  }
  return rows;
}

}  // namespace

TEST_CASE(
    "batch: each line runs a case once, what fails is listed again, and all is gathered in the plan's "
    "order") {
  const Batch batch;
  const std::vector<std::string> lines = batch.lines();
  REQUIRE(lines.size() == 6);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    INFO(lines[i]);
    CHECK(run_line(lines[i]) == (i < 4 ? 0 : 1));
  }
  const Run again = run_furrow(lines[0].substr(lines[0].find("batch ")));
  CHECK(again.exit_code == 0);
  CHECK(again.out.find("was finished before") != std::string::npos);
  CHECK(batch.lines() == std::vector<std::string>(lines.begin() + 4, lines.end()));

  const Run gathered = batch.furrow("gather " + batch.plan + " --json");
  CHECK(gathered.exit_code == 4);
  const json counts = json::parse(gathered.out);
  CHECK(counts["finished"] == 4);
  CHECK(counts["failed"] == 2);
  CHECK(counts["missed"] == 0);
  const std::vector<json> rows = batch.rows();
  REQUIRE(rows.size() == 6);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CHECK(rows[i]["values"]["fabric"] == (i % 2 ? "silk" : "cotton"));
    CHECK(rows[i]["state"] == (i < 4 ? "finished" : "failed"));
    CHECK(rows[i].contains("mesh") == (i < 4));
  }
  CHECK(rows[0]["report"]["outcome"] == "finished");
  CHECK(std::filesystem::exists(batch.folder / "out/" + rows[0]["mesh"].get<std::string>()));
  CHECK(rows[4]["exit"] == 3);
  CHECK(rows[4]["error"].get<std::string>().find("broken.obj") != std::string::npos);
  const std::string page = read_text(batch.folder / "out/report.html");
  CHECK(page.find("Cloths &lt;fall&gt; &amp; rest") != std::string::npos);
  CHECK(page.find("class=failed") != std::string::npos);
}

TEST_CASE("batch: a verdict that is no success is finished, counted, and no success of the batch", "[long]") {
  const ScratchDirectory folder;
  write_text(folder / "falls.obj", square);
  const std::string plan = folder / "plan.toml";
  write_text(plan,
             "output = \"out\"\n[options]\nsubdivide = 0\npin-vertices = 0\nmax-iterations = "
             "1\n[cases]\ngarment = [\"falls.obj\"]\n");
  const std::string line = run_furrow("batch list " + plan).out;
  CHECK(run_line(line) == 0);
  const Run gathered = run_furrow("batch gather " + plan);
  CHECK(gathered.exit_code == 4);
  CHECK(gathered.out.find("1 finished (1 of them with exit code 4: no success)") != std::string::npos);
  CHECK(read_text(folder / "out/report.html").find("finished, exit 4") != std::string::npos);
  CHECK(run_furrow("batch list " + plan).out.empty());
}

TEST_CASE("batch: cases share what is made of their body, and come to the same without", "[long]") {
  const ScratchDirectory folder;
  write_text(folder / "cloth.obj", "v 0 0.4 0\nv 0.1 0.4 0\nv 0.1 0.4 0.1\nv 0 0.4 0.1\nf 1 3 2\nf 1 4 3\n");
  write_text(folder / "box.obj",
             "v 0 0 0\nv .3 0 0\nv .3 .3 0\nv 0 .3 0\nv 0 0 .3\nv .3 0 .3\nv .3 .3 .3\nv 0 .3 .3\n"
             "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n");
  const std::string plan = folder / "plan.toml";
  write_text(plan,
             "picture = false\n[options]\nsubdivide = 1\nmax-iterations = 5\ngap = 0.001\n[cases]\ngarment = "
             "[\"cloth.obj\"]\nbody = [\"box.obj\"]\nfabric = [\"cotton\", \"silk\"]\n");
  const auto run_all = [&](bool shares) {
    const json listed = json::parse(run_furrow("batch list --all --json " + plan).out);
    for (const json& line : listed["lines"]) {
      std::string text = line;
      const std::string option = " --cache " + (folder / "plan-results/cache");
      REQUIRE(text.find(option) != std::string::npos);
      if (!shares) text.erase(text.find(option), option.size());
      run_line(text);
    }
    std::map<std::string, std::string> meshes;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "plan-results/meshes"))
      meshes[entry.path().filename()] = read_text(entry.path());
    return meshes;
  };
  const auto shared = run_all(true);
  CHECK(shared.size() == 2);
  std::size_t kept = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "plan-results/cache"))
    kept += entry.path().extension() != ".lock";
  CHECK(kept == 2);  // the body and its field
  std::filesystem::remove_all(folder / "plan-results");
  CHECK(run_all(false) == shared);
}

TEST_CASE("batch: a changed garment is another case, and the old one's result stays") {
  const Batch batch;
  const std::vector<std::string> before = batch.lines();
  REQUIRE(run_line(before[0]) == 0);
  write_text(batch.folder / "a cloth.obj", std::string(square) + "v 3 3 0\nf 2 5 3\n");
  const std::vector<std::string> after = batch.lines();
  CHECK(after.size() == 6);
  CHECK(after[0] != before[0]);
  CHECK(after[2] == before[2]);
}

TEST_CASE("batch: Slurm's tasks run their chunks, and only what failed is submitted again", "[long]") {
  const Batch batch;
  const Run made = batch.furrow("slurm " + batch.plan + " --chunk 4 --json");
  REQUIRE(made.exit_code == 0);
  const json told = json::parse(made.out);
  CHECK(told["tasks"] == 2);
  const std::string array = told["written"][1].get<std::string>();
  CHECK(run_line("SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=0 sh " + array) == 0);
  CHECK(run_line("SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=1 sh " + array) == 1);
  CHECK(run_line("sh " + told["written"][2].get<std::string>()) == 4);
  const std::vector<json> rows = batch.rows();
  CHECK(rows[0]["job"] == "7_0");
  CHECK(rows[5]["job"] == "7_1");

  write_text(batch.folder / "sbatch", "#!/bin/sh\necho \"$@\" >>" + (batch.folder / "calls") + "\necho 12\n");
  std::filesystem::permissions(batch.folder / "sbatch", std::filesystem::perms::owner_all);
  const auto submit = [&] {
    return run_program("sh",
                       {"-c", "PATH=" + batch.folder.path().string() + ":$PATH " +
                                  std::string(batch.lines()[0].substr(0, batch.lines()[0].find(" batch"))) +
                                  " batch slurm " + batch.plan + " --submit --sbatch=--mem=1G --json"});
  };
  const json submitted = json::parse(submit().out);
  CHECK(submitted["tasks"] == 1);
  CHECK(submitted["job"] == "12");
  CHECK(read_text(submitted["written"][0].get<std::string>()).find("broken.obj") != std::string::npos);
  const std::string calls = read_text(batch.folder / "calls");
  CHECK(calls.find("--mem=1G") != std::string::npos);
  CHECK(calls.find("--dependency=afterany:12") != std::string::npos);

  const Batch other;  // the same cases, line by line
  for (const std::string& line : other.lines()) run_line(line);
  other.furrow("gather " + other.plan);
  const std::vector<json> a = lasting(rows), b = lasting(other.rows());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i]["case"] == b[i]["case"]);
    CHECK(a[i]["state"] == b[i]["state"]);
    if (i < 4) CHECK(a[i]["report"]["outcome"] == b[i]["report"]["outcome"]);
  }
}

TEST_CASE("batch: no word of a plan reaches a shell, neither by a line end nor by a quote") {
  const ScratchDirectory folder;
  const std::string pwned = folder / "PWNED", plan = folder / "plan.toml", odd = "it's $(touch PWNED)";
  write_text(folder / "a 'cloth' $(x) {}.obj", square);
  const auto write_plan = [&](const std::string& fabric) {
    write_text(plan,
               "command = \"simulate\"\noutput = 'out {} $(touch x)'\n[options]\nseconds = 0.01\nfabric = " +
                   json(fabric).dump() + "\n[cases]\ngarment = [\"a 'cloth' $(x) {}.obj\"]\n");
  };
  write_plan("cotton\ntouch " + pwned + "; : \n");
  for (const std::string action : {"list ", "parallel ", "slurm ", "gather "}) {
    const Run refused = run_furrow("batch " + action + plan);
    CHECK(refused.exit_code == 3);
    CHECK(refused.err.find("plan.toml:5:1: options.fabric: \"cotton\\ntouch") != std::string::npos);
  }
  CHECK_FALSE(std::filesystem::exists(folder / "out {} $(touch x)"));
  write_plan(odd);  // no fabric, which each way to run it says
  const auto error_of = [&] {
    const std::string rows = read_text(folder / "out {} $(touch x)/results.jsonl");
    std::filesystem::remove_all(folder / "out {} $(touch x)");
    return json::parse(rows)["error"].get<std::string>();
  };
  CHECK(run_furrow("batch parallel " + plan).exit_code == 4);
  const std::string error = error_of();
  INFO(error);
  CHECK(error.find(odd) != std::string::npos);
  run_line(run_furrow("batch list " + plan).out);
  run_furrow("batch gather " + plan);
  CHECK(error_of() == error);
  const json scripts = json::parse(run_furrow("batch slurm " + plan + " --json").out);
  const std::string array = scripts["written"][1];
  CHECK(run_program("env", {"SLURM_ARRAY_TASK_ID=0", "sh", array}).exit_code == 1);
  run_furrow("batch gather " + plan);
  CHECK(error_of() == error);
  for (const std::string& file : {pwned, std::string("PWNED")}) CHECK_FALSE(std::filesystem::exists(file));
}

TEST_CASE("batch: cases side by side come to what they come to one after the other") {
  std::vector<std::vector<json>> outcomes;
  for (const char* jobs : {"1", "4"}) {
    const Batch batch;
    CHECK(batch.furrow("parallel " + batch.plan + " --jobs " + jobs).exit_code == 4);
    std::vector<json>& all = outcomes.emplace_back();
    for (const json& row : lasting(batch.rows()))
      all.push_back(row["state"] == "finished" ? row["report"]["outcome"] : row["state"]);
  }
  REQUIRE(outcomes[0].size() == 6);
  CHECK(outcomes[0] == outcomes[1]);
}

TEST_CASE("batch: what is wrong with a call is told, and nothing is written") {
  const Batch batch;
  CHECK(batch.furrow("case " + (batch.folder / "r.json")).exit_code == 2);
  CHECK(batch.furrow("list " + batch.plan + " more").exit_code == 2);
  CHECK(batch.furrow("list " + batch.plan + " --jobs 2").exit_code == 2);
  CHECK(batch.furrow("list " + (batch.folder / "none.toml")).exit_code == 3);
  const std::string typo = batch.folder / "typo.toml";
  write_text(typo, "[cases]\ngarment = [\"b.obj\"]\nfabrc = [\"silk\"]\n");
  const Run mistyped = batch.furrow("list " + typo);
  CHECK(mistyped.exit_code == 2);
  CHECK(mistyped.err.find("furrow drape has no option 'fabrc'; did you mean 'fabric'?") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(batch.folder / "out"));
  const Run all = batch.furrow("list " + batch.plan + " --all --json");
  CHECK(json::parse(all.out)["lines"].size() == 6);
}
