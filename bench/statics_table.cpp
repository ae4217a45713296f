// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/statics_table.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

namespace furrow::bench {
namespace {

/// A field of the table: in quotes where it has a comma.
std::string field(const char* text) {
  const std::string plain = text;
  return plain.find(',') == std::string::npos ? plain : '"' + plain + '"';
}

}  // namespace

void print_header() {
  std::puts(
      "what,mesh,parameter,rows,columns,measured,reference,error,target,verdict,iterations,factorisations,"
      "residual,converged,stable,seconds");
}

void print(const Row& r) {
  const char* verdict = !(r.target > 0) ? "" : std::abs(r.error) <= r.target ? "met" : "missed";
  std::printf("%s,%s,%g,%d,%d,%.9g,%.9g,%.3e,%g,%s,%d,%d,%.1e,%d,%d,%.2f\n", field(r.what).c_str(),
              field(r.mesh).c_str(), r.parameter, r.rows, r.columns, r.measured, r.reference, r.error,
              r.target, verdict, r.report.iterations, r.report.factorisations, r.report.residual,
              r.report.converged, r.report.stable, r.seconds);
  std::fflush(stdout);
}

void rest(physics::Cloth& cloth, const physics::SettleOptions& options, Row& row) {
  const auto start = std::chrono::steady_clock::now();
  row.report = tests::find_rest(cloth, options);
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace furrow::bench
