// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <memory>

#include "bridge/body.h"
#include "cli/common.h"
#include "cli/subcommands.h"
#include "io/picture/render_slice.h"
#include "io/scene/field_file.h"
#include "jobs/run/body.h"

namespace furrow::cli {
namespace {

struct SdfArguments : CommonArguments {
  std::string body_path, gradient = "exact";
  io::SceneBody body;
  std::string slice, at;
};

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

/// Error of the field at points of a lattice in its band [m], by exact distance.
Json errors(const BodyCollider& body) {
  double largest = 0, sum = 0;
  int points = 0;
  constexpr int n = 40;
  for (int i = 0; i < n * n * n; ++i) {
    const physics::Vec3 u((i % n + 0.5) / n, (i / n % n + 0.5) / n, (i / n / n + 0.5) / n);
    const physics::Vec3 x = body.exact.low() + u.cwiseProduct(body.exact.high() - body.exact.low());
    const double exact = body.exact.at(x).value;
    if (exact > 0.03 || exact < -0.02) continue;
    const double error = std::abs(body.field.at(x).value - exact);
    largest = std::max(largest, error);
    sum += error;
    ++points;
  }
  return {{"points", points}, {"max", largest}, {"mean", points ? sum / points : 0}};
}

void sdf(SdfArguments a) {
  a.body.mesh = a.body_path;
  a.body.options.gradient = a.gradient == "exact" ? physics::GradientRule::exact_derivative
                                                  : physics::GradientRule::interpolated_corners;
  if (a.out == "-") throw UsageError("-o: a field needs a file name");
  check_folder(a.out);
  check_picture(a.slice, "--slice");
  refuse_same({a.out, a.slice}, {a.body_path});
  catch_interrupts();
  Terminal terminal(a);
  const auto start = std::chrono::steady_clock::now();
  const BodyCollider body = load_body(a.body, {a, terminal});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const physics::DistanceFieldReport& r = body.field.report();
  if (!a.out.empty()) io::write_field(a.out, body.field, body.triangles);
  if (!a.slice.empty())
    io::write_png(a.slice, io::render_slice(body.field, body.exact.low(), body.exact.high()));
  Json report{{"tolerance", r.tolerance},
              {"leaves", r.leaves},
              {"samples", r.samples},
              {"depth", r.depth},
              {"leaves_at_max_depth", r.leaves_at_max_depth},
              {"bytes", body.field.memory()},
              {"sign", to_text(r.sign.rule)},
              {"seconds", seconds},
              {"error", errors(body)}};
  if (!a.at.empty()) {
    const std::vector<double> p = parse_numbers(a.at, 3, "--at");
    const physics::Vec3 x(p[0], p[1], p[2]);
    const physics::SignedDistance field = body.field.at(x);
    report["at"] = {{"distance", field.value},
                    {"gradient", {field.gradient.x(), field.gradient.y(), field.gradient.z()}},
                    {"exact_distance", body.exact.at(x).value}};
  }
  print_report(report, a);
}

}  // namespace

void add_sdf(CLI::App& app) {
  auto a = std::make_shared<SdfArguments>();
  CLI::App* sub = app.add_subcommand("sdf",
                                     "Make the signed distance field of a body; negative inside\n\n"
                                     "  furrow sdf body.obj -o body.field --slice body.png");
  sub->add_option("body", a->body_path, "body to read")->required();
  sub->add_option("-o,--output", a->out, "file to keep the field in, for furrow simulate --field");
  sub->add_option("--slice", a->slice, "PNG of the field in the body's middle plane, seen from the front");
  sub->add_option("--at", a->at, "report distance and gradient at x,y,z [m]");
  sub->add_option("--tolerance", a->body.options.tolerance,
                  "error of the field [m]; default 1/1000 of the body's diagonal, at most 0.002");
  sub->add_option("--gradient", a->gradient,
                  "exact (of the interpolated distance) or interpolated (of the corners', as in the paper)")
      ->check(CLI::IsMember({"exact", "interpolated"}))
      ->capture_default_str();
  add_common_options(*sub, *a);
  sub->callback([a] { sdf(*a); });
}

}  // namespace furrow::cli
