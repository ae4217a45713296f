// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/finite_report.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace furrow::jobs {
namespace {

void make_finite(Json& value, const std::string& path, Json& found) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) {
    found.push_back(path + ": " + (std::isnan(value.get<double>()) ? "not a number" : "infinite"));
    value = nullptr;
  } else if (value.is_structured()) {
    for (auto& [key, item] : value.items()) make_finite(item, path.empty() ? key : path + "." + key, found);
  }
}

}  // namespace

Json finite_report(const Json& report) {
  Json versioned{{"schema", 1}}, found = Json::array();
  versioned.update(report);
  make_finite(versioned, "", found);
  if (!found.empty()) versioned["not_finite"] = found;
  return versioned;
}

}  // namespace furrow::jobs
