// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/body/field.h"

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/picture/png_file.h"
#include "io/picture/render_slice.h"
#include "jobs/base/output_checks.h"
#include "physics/base/cancel_scope.h"

namespace furrow::jobs {
namespace {

const char* to_text(physics::SignRule rule) {
  switch (rule) {
    case physics::SignRule::pseudonormal:
      return "pseudonormal";
    case physics::SignRule::sides:
      return "sides of the uncrossed parts, winding number where they cross";
    case physics::SignRule::winding:
      return "winding number";
  }
  return "";
}

FieldErrors errors_of(const BodyCollider& body) {
  FieldErrors errors;
  double sum = 0;
  constexpr int n = 40;
  for (int i = 0; i < n * n * n; ++i) {
    const physics::Vec3 u((i % n + 0.5) / n, (i / n % n + 0.5) / n, (i / n / n + 0.5) / n);
    const physics::Vec3 x = body.exact.low() + u.cwiseProduct(body.exact.high() - body.exact.low());
    const double exact = body.exact.at(x).value;
    if (exact > 0.03 || exact < -0.02) continue;
    const double error = std::abs(body.field.at(x).value - exact);
    errors.largest = std::max(errors.largest, error);
    sum += error;
    ++errors.points;
  }
  errors.mean = errors.points ? sum / errors.points : 0;
  return errors;
}

}  // namespace

FieldReport field(const FieldJob& job, Listener& listener) {
  const physics::CancelScope cancelling([&listener] { return listener.cancelled(); });
  check_picture(job.slice.string(), "`picture`");
  check_replaced({job.slice.string()}, {job.body.mesh.string()}, listener);
  const auto start = std::chrono::steady_clock::now();
  FieldReport report{load_body(job.body, {job.frame, listener}), {}, job.at, 0};
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const BodyCollider& body = report.body;
  if (!job.slice.empty())
    io::write_png(job.slice, io::render_slice(body.field, body.exact.low(), body.exact.high()));
  report.errors = errors_of(body);
  return report;
}

Json to_json(const FieldReport& report) {
  const BodyCollider& body = report.body;
  const physics::DistanceFieldReport& r = body.field.report();
  const FieldErrors& e = report.errors;
  Json json{{"tolerance", r.tolerance},
            {"leaves", r.leaves},
            {"samples", r.samples},
            {"depth", r.depth},
            {"leaves_at_max_depth", r.leaves_at_max_depth},
            {"bytes", body.field.memory()},
            {"sign", to_text(r.sign.rule)},
            {"seconds", report.seconds},
            {"error", {{"points", e.points}, {"max", e.largest}, {"mean", e.mean}}}};
  if (report.at) {
    const physics::SignedDistance field = body.field.at(*report.at);
    json["at"] = {{"distance", field.value},
                  {"gradient", {field.gradient.x(), field.gradient.y(), field.gradient.z()}},
                  {"exact_distance", body.exact.at(*report.at).value}};
  }
  return json;
}

}  // namespace furrow::jobs
