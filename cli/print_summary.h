// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

/// What people are told of a job, in ten lines at most: what happened, what to look at, where it was written,
/// what next. All of it is taken from the report that --json prints; -v prints the rest of that.
namespace furrow::cli {

using Json = nlohmann::ordered_json;

struct Summary {
  std::vector<std::string> lines = {};    ///< what happened, and what to look at; more than eight are cut
  std::vector<std::string> written = {};  ///< files; "" and "-" are passed over
  /// Words of a call that is likely to follow; none: none. Those in capitals are for the user to fill in.
  std::vector<std::string> next = {};
};

/// The lines about a job's report.
std::vector<std::string> info_lines(const Json& report);
std::vector<std::string> doctor_lines(const Json& report);  ///< whose ailments are sentences
std::vector<std::string> subdivide_lines(const Json& report);
std::vector<std::string> smooth_lines(const Json& report);
std::vector<std::string> wrinkle_lines(const Json& report);
std::vector<std::string> strokes_lines(const Json& report);
std::vector<std::string> quality_lines(const Json& report);
std::vector<std::string> simulate_lines(const Json& report);
std::vector<std::string> keep_lines(const Json& report);
std::vector<std::string> chart_lines(const Json& report);
std::vector<std::string> sdf_lines(const Json& report);
std::vector<std::string> render_lines(const Json& report);
std::vector<std::string> drape_lines(const Json& report);
std::vector<std::string> fit_lines(const Json& report);
std::vector<std::string> transfer_lines(const Json& report);
std::vector<std::string> bake_lines(const Json& report);

/// At most ten lines; the last of those about the job says how many are left out.
void print_summary(std::ostream& out, const Summary& summary);

}  // namespace furrow::cli
