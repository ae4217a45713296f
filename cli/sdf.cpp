// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/common.h"
#include "cli/subcommands.h"
#include "jobs/body/field.h"

namespace furrow::cli {
namespace {

struct SdfArguments : CommonArguments {
  std::string body_path, gradient = "exact";
  io::SceneBody body;
  std::string slice, at;
};

FieldJob job_of(const SdfArguments& a) {
  FieldJob job{a.body, a, a.slice, {}};
  job.body.mesh = a.body_path;
  job.body.options.gradient = a.gradient == "exact" ? physics::GradientRule::exact_derivative
                                                    : physics::GradientRule::interpolated_corners;
  if (!a.at.empty()) {
    const std::vector<double> p = parse_numbers(a.at, 3, "--at");
    job.at = physics::Vec3(p[0], p[1], p[2]);
  }
  return job;
}

Lines sdf_lines(const Json& report) {
  Lines lines{"field of " + std::to_string(count_of(report, "samples")) + " samples, " +
              number(1e-6 * value_of(report, "bytes")) + " MB, in " + number(value_of(report, "seconds")) +
              " s"};
  const Json& error = table_of(report, "error");
  lines.push_back("error: " + length(error, "mean") + " on average, at most " + length(error, "max") + "; " +
                  length(report, "tolerance") + " asked");
  if (const Json& at = table_of(report, "at"); !at.empty())
    lines.push_back("there: distance " + length(at, "distance") + ", exactly " +
                    length(at, "exact_distance"));
  return lines;
}

void sdf(const SdfArguments& a) {
  const FieldJob job = job_of(a);
  catch_interrupts();
  Terminal terminal(a);
  const Json json = to_json(jobs::field(job, terminal));
  print_report(
      json, a,
      {sdf_lines(json),
       {a.slice},
       a.body.cache.empty() ? std::vector<std::string>{}
                            : std::vector<std::string>{"furrow", "drape", "GARMENT", "--body", a.body_path,
                                                       "--cache", a.body.cache.string(), "-o", "worn.ply"}});
}

void add_sdf(CLI::App& sub, SdfArguments& a) {
  sub.add_option("body", a.body_path, "body to read")->required();
  sub.add_option("--cache", a.body.cache, "folder to keep the field in, for furrow drape --cache and others");
  sub.add_option("--picture", a.slice, "PNG of the field in the body's middle plane, seen from the front");
  sub.add_option("--at", a.at, "report distance and gradient at x,y,z [m]");
  sub.add_option("--tolerance", a.body.options.tolerance,
                 "error of the field [m]; default 1/1000 of the body's diagonal, at most 0.002");
  sub.add_option("--gradient", a.gradient,
                 "exact (of the interpolated distance) or interpolated (of the corners', as in the paper)")
      ->check(CLI::IsMember({"exact", "interpolated"}))
      ->capture_default_str();
  sub.add_option("--body-unit", a.body.unit, "unit of the body's file: as --unit, which it goes before")
      ->check(CLI::IsMember({"m", "cm", "mm", "inch"}));
}

const Subcommand sdf_subcommand(110, "sdf",
                                "Make the signed distance field of a body; negative inside\n\n"
                                "  furrow sdf body.obj --cache cache --picture body.png",
                                add_sdf, sdf);

}  // namespace
}  // namespace furrow::cli
