// SPDX-License-Identifier: GPL-3.0-or-later
// furrow fit: reports, pictures, coloured meshes, wrong calls.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "geometry/mesh/property_names.h"
#include "geometry/mesh/vertex_attributes.h"
#include "io/mesh/mesh_file.h"
#include "io/picture/png_file.h"
#include "run_json.h"

using namespace furrow;
using namespace furrow::tests;
using nlohmann::json;

namespace {

constexpr int around = 48;

/// A tube of `up` rings of cells around the y axis as OBJ.
std::string tube(double radius, double from, double to, int up) {
  std::string text;
  for (int j = 0; j <= up; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      text += "v " + std::to_string(radius * std::sin(angle)) + " " +
              std::to_string(from + (to - from) * j / up) + " " + std::to_string(radius * std::cos(angle)) +
              "\n";
    }
  for (int j = 0; j < up; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = i + j * around + 1, b = (i + 1) % around + j * around + 1;
      text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + around) + " " +
              std::to_string(a + around) + "\n";
    }
  return text;
}

struct TubeFiles {
  ScratchDirectory scratch;
  std::string body = scratch / "body.obj", made = scratch / "made.obj", worn = scratch / "worn.obj";
  TubeFiles() {
    write_text(body, tube(0.15, 0, 1.7, 34));
    write_text(made, tube(0.148, 0.7, 1.3, 12));
    write_text(worn, tube(0.16, 0.7, 1.3, 12));
  }
  std::string operator/(const std::string& name) const { return scratch / name; }
};

double ngon(double radius) { return 2 * around * radius * std::sin(std::numbers::pi / around); }

}  // namespace

TEST_CASE("fit: a stretched tube on a column has the known strain, room and distances") {
  TubeFiles f;
  const json r = succeed("fit --json " + f.worn + " --rest-shape " + f.made + " --body " + f.body + " -o " +
                         (f / "c.ply") + " --section waist=1.0");
  CHECK(r["strain"]["p50"].get<double>() == Approx(0.16 / 0.148 - 1).epsilon(1e-3));
  CHECK(r["strain"]["share_over"].get<double>() == Approx(1));
  CHECK(r["distance"]["median"].get<double>() == Approx(0.01).epsilon(0.01));
  REQUIRE(r["ease"].size() == 3);
  CHECK(r["ease"][1]["section"] == "waist");
  CHECK(r["ease"][1]["height"] == 1.0);
  CHECK(r["ease"][1]["ease"].get<double>() == Approx(ngon(0.01)).epsilon(1e-3));
  CHECK(r["ease"][1]["rest_ease"].get<double>() == Approx(-ngon(0.002)).epsilon(1e-2));
  REQUIRE(r["tight_zones"].size() == 1);
  CHECK(r["tight_zones"][0]["side"] == "around");
  CHECK(r["loose_zones"].empty());
  const io::MeshFile file = io::read_mesh(f / "c.ply");
  CHECK(geometry::find_map(file.mesh, geometry::attribute::color));
  const auto attributes = geometry::vertex_attributes(file.mesh);
  REQUIRE(attributes.size() == 2);
  for (const auto& attribute : attributes) {
    INFO(attribute.name);
    const bool strain = attribute.name == "strain";
    CHECK((strain || attribute.name == "fit_distance"));
    for (auto v : file.mesh->vertices())
      CHECK(attribute.values[v] == Approx(strain ? 0.16 / 0.148 - 1 : 0.01).epsilon(0.01));
  }
  // The coloured garment is a garment: it knows its rest itself now, and gives the same report.
  const json again = succeed("fit --json " + (f / "c.ply") + " --body " + f.body);
  CHECK(again["strain"] == r["strain"]);
}

TEST_CASE("fit: without rest lengths it says so, and colours by distance") {
  TubeFiles f;
  const Run run = run_furrow("fit --json " + f.worn + " --body " + f.body);
  REQUIRE(run.exit_code == 0);
  CHECK(run.err.find("no rest lengths") != std::string::npos);
  CHECK(json::parse(run.out)["strain"].is_null());
  const Run asked = run_furrow("fit " + f.worn + " --body " + f.body + " --colour strain");
  CHECK(asked.exit_code == 3);
  CHECK(asked.err.find("--rest") != std::string::npos);
  const Run text = run_furrow("fit -q " + f.worn + " --body " + f.body);
  CHECK(text.exit_code == 0);
  CHECK(text.out.empty());
  CHECK(run_furrow("fit -v " + f.worn + " --body " + f.body).out.find("section") != std::string::npos);
}

TEST_CASE("fit: pictures of one garment from both sides, and of several with one legend", "[release]") {
  TubeFiles f;
  const std::string small = " --size 220,260 --quality draft ";
  succeed("fit --json " + f.worn + " --rest-shape " + f.made + " --body " + f.body + small + "--picture " +
          (f / "one.png"));
  const io::Image one = io::read_png(f / "one.png");
  CHECK(one.width == 8 + 2 * (220 + 8));
  succeed("fit --json " + f.worn + " --rest-shape " + f.made + " --body " + f.body + small + "--no-legend " +
          "--picture " + (f / "bare.png"));
  const io::Image bare = io::read_png(f / "bare.png");
  CHECK(bare.width == one.width);
  CHECK(bare.height < one.height);
  CHECK(std::equal(bare.rgb.begin(), bare.rgb.end(), one.rgb.begin()));
  succeed("fit --json " + f.worn + " --body " + f.body + small + "--view back --picture " + (f / "back.png") +
          " --save-camera " + (f / "back.json"));
  CHECK(io::read_png(f / "back.png").width == 8 + 220 + 8);
  succeed("fit --json " + f.worn + " --body " + f.body + " --quality draft --camera " + (f / "back.json") +
          " --picture " + (f / "again.png"));
  CHECK(read_text(f / "again.png") == read_text(f / "back.png"));
  const json r = succeed("fit --json --compare " + f.worn + " " + f.made + " " + f.worn + " --body " +
                         f.body + small + "--captions S,M,L --picture " + (f / "three.png"));
  CHECK(io::read_png(f / "three.png").width == 8 + 3 * (220 + 8));
  REQUIRE(r["garments"].size() == 3);
  CHECK(r["garments"][0]["garment"] == f.worn);
  CHECK(r["garments"][1]["distance"]["vertices_inside"].get<int>() > 0);
  // The red of stretched cloth is there where the strain is shown, and not where the distance is.
  const auto reds = [](const io::Image& image) {
    int n = 0;
    for (std::size_t i = 0; i < 3 * std::size_t(image.width) * 200; i += 3)
      n += image.rgb[i] > 1.8 * image.rgb[i + 1] && image.rgb[i] > 1.8 * image.rgb[i + 2];
    return n;
  };
  CHECK(reds(one) > 1000);
  CHECK(reds(io::read_png(f / "back.png")) == 0);
}

TEST_CASE("fit: wrong calls of fit are told before the work", "[long]") {
  TubeFiles f;
  const std::string good = "fit " + f.worn + " --body " + f.body + " ";
  for (const std::string& call :
       {good + "--section neck=1.2", good + "--section chest", good + "--section chest=high",
        good + "--tight 0", good + "--loose -1", good + "--contact nan", good + "--range 0",
        good + "--colour red", good + "-o " + f.worn, good + "--picture " + f.body,
        good + "--picture " + (f / "a.jpg"), good + "--view back", good + "--captions a",
        good + "--picture " + (f / "a.png") + " --captions a,b",
        "fit " + f.worn + " " + f.made + " --body " + f.body,
        "fit --compare " + f.worn + " " + f.made + " --body " + f.body + " -o " + (f / "o.ply"),
        std::string("fit ") + f.worn}) {
    INFO("furrow " << call);
    const Run run = run_furrow(call);
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("error: ") != std::string::npos);  // perhaps behind what was repaired
  }
  CHECK(run_furrow(good + "--rest-shape " + f.body).exit_code == 3);
  write_text(f / "empty.obj", "v 0 0 0\n");
  CHECK(run_furrow("fit " + (f / "empty.obj") + " --body " + f.body).exit_code == 3);
  CHECK(run_furrow("fit " + f.worn + " --body " + (f / "empty.obj")).exit_code == 3);
  CHECK(read_text(f.worn) == tube(0.16, 0.7, 1.3, 12));
}
