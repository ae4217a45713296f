// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/card.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "jobs/body/body.h"
#include "jobs/chain/keep.h"
#include "jobs/chain/wrinkle.h"
#include "jobs/draw/quality.h"
#include "jobs/mesh/bake.h"
#include "jobs/mesh/doctor.h"
#include "jobs/mesh/smooth.h"
#include "jobs/mesh/subdivide.h"
#include "jobs/mesh/transfer.h"
#include "jobs/move/chart.h"
#include "jobs/move/simulate.h"
#include "jobs/rest/drape.h"
#include "jobs/rest/fit.h"

using namespace furrow;
using namespace furrow::jobs;

namespace {

const CardRow& row_of(const std::vector<CardRow>& rows, const std::string& name) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const CardRow& r) { return r.name == name; });
  REQUIRE(found != rows.end());
  return *found;
}

template <class Job>
std::string refusal(const Job& job) {
  try {
    check_card(job);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

template <class Job>
void check_rows() {
  Job job;
  CHECK(refusal(job) == "");  // a default is within its range
  std::set<std::string> names;
  for (const CardRow& row : card(job)) {
    INFO(row.name);
    CHECK(names.insert(row.name).second);
    CHECK_FALSE(row.words.empty());
    CHECK(std::string(row.name).find('-') == std::string::npos);
  }
}

}  // namespace

TEST_CASE("card: of each job, no name is there twice, and the defaults lie within their ranges") {
  check_rows<BakeJob>();
  check_rows<BodyJob>();
  check_rows<ChartJob>();
  check_rows<DoctorJob>();
  check_rows<DrapeJob>();
  check_rows<FitJob>();
  check_rows<KeepJob>();
  check_rows<QualityJob>();
  check_rows<SimulateJob>();
  check_rows<SmoothJob>();
  check_rows<SubdivideJob>();
  check_rows<TransferJob>();
  check_rows<WrinkleJob>();
}

TEST_CASE("card: a number out of its range is refused by the name of its option, with range and value") {
  DrapeJob job;
  job.settings.thickness = 0.1;
  CHECK(refusal(job) == "`cloth_thickness` takes a number in [1e-05, 0.05], not 0.1");
  job.settings.thickness = 0.05;
  CHECK(refusal(job) == "");
  job.settings.residual = 0;
  CHECK(refusal(job) == "`residual` takes a number > 0, not 0");
  job.settings.residual = NAN;
  CHECK(refusal(job) == "`residual` takes a number > 0, not nan");
  job.settings.residual = HUGE_VAL;
  CHECK(refusal(job) == "`residual` takes a number > 0, not inf");
  job.settings.residual = 1e-3;
  job.settings.iterations = -1;
  CHECK(refusal(job) == "`max_iterations` takes a whole number >= 0, not -1");
  job.settings.iterations = 0;
  job.budget = HUGE_VAL;
  CHECK(refusal(job) == "");
  job.subdivide = 7;
  CHECK(refusal(job) == "`subdivide` takes a whole number in [0, 6], not 7");
}

TEST_CASE("card: a measure of a body that nobody asks for is none, another one has its range") {
  BodyJob job;
  job.measures.height = 0.5;
  CHECK(refusal(job) == "`height` takes a number in [0.9, 2.5], not 0.5");
  job.measures.height = 0;
  CHECK(refusal(job) == "");
}

TEST_CASE("card: a choice sets its field by its words, and tells the one that holds") {
  DrapeJob job;
  job.settings.loose = LooseUse::fall;
  const Choice loose = std::get<Choice>(row_of(card(job), "loose").value);
  CHECK(loose.words == std::vector<std::string>{"hold", "drop", "fall"});
  CHECK(loose.usual == "fall");
  loose.set(1);
  CHECK(job.settings.loose == LooseUse::drop);
  std::optional<std::string> unit;
  const Choice units = unit_choice(unit);
  CHECK(units.usual == "");
  units.set(1);
  CHECK(unit == "cm");
}

TEST_CASE("card: what turns something off sets the field the other way round") {
  KeepJob job;
  const Flag flag = std::get<Flag>(row_of(card(job), "no_balance").value);
  flag.set(true);
  CHECK_FALSE(job.balance);
  flag.set(false);
  CHECK(job.balance);
}

TEST_CASE("card: rest=keep asks for the settings that the shape is kept in, another word takes them back") {
  WrinkleJob job;
  const Choice rest = std::get<Choice>(row_of(card(job), "rest").value);
  rest.set(3);
  CHECK(job.keep.has_value());
  rest.set(2);
  CHECK_FALSE(job.keep.has_value());
  CHECK(job.options.rest == geometry::RestRule::flat);
}

TEST_CASE("card: a band is refused where it cannot be") {
  DrapeJob job;
  const auto bands = std::get<NamedNumbers>(row_of(card(job), "band").value);
  bands.add("top", 0.9);
  CHECK_THROWS_WITH(bands.add("top", 0.8), "'top' has a band already");
  CHECK_THROWS_WITH(bands.add("hem", 3), "the length must be above 0 and at most 2");
  REQUIRE(job.settings.bands.size() == 1);
  CHECK(job.settings.bands[0].length == 0.9);
}

TEST_CASE("card: help has the unit, the range if asked for, and the default of the field") {
  DrapeJob job;
  const std::vector<CardRow> rows = card(job);
  const std::string words = "force in a band at twice its length [N]";
  CHECK(described(row_of(rows, "band_stiffness"), false) == words + " (default 50)");
  CHECK(described(row_of(rows, "band_stiffness"), true) == words + ", >= 0 (default 50)");
  CHECK(described(row_of(rows, "budget"), true).ends_with("[s], > 0, inf for no end (default 60)"));
  CHECK(described(row_of(rows, "loose"), false).ends_with("as the rest (default hold)"));
  CHECK(described(row_of(rows, "made_for"), true) == row_of(rows, "made_for").words);
}
