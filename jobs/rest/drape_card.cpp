// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <thread>

#include "jobs/base/card.h"
#include "jobs/rest/drape.h"
#include "jobs/rest/drape_plan.h"

namespace furrow::jobs {
namespace {

NamedNumbers band_list(std::vector<Band>& bands) {
  return {"loop", "length",
          "write a border loop and the band's length as a share of the loop's: `band=top=0.95` is a band 5 % "
          "shorter than the garment's upper border",
          [&bands](const std::string& loop, double length) {
            if (!(length > 0 && length <= 2))
              throw std::invalid_argument("the length must be above 0 and at most 2");
            if (std::any_of(bands.begin(), bands.end(), [&](const Band& b) { return b.loop == loop; }))
              throw std::invalid_argument("'" + loop + "' has a band already");
            bands.push_back({loop, length});
          }};
}

}  // namespace

std::vector<CardRow> card(DrapeJob& job) {
  using enum Group;
  using enum Audience;
  DrapeSettings& s = job.settings;
  return {
      {"output", output, everyone, &job.output,
       "mesh to write, as it is worn; PLY keeps strain and distance. Several garments are a file each: "
       "worn.ply becomes worn-shirt.ply, {} stands for the garment's name"},
      {"animation", output, few, &s.animation,
       "the way to rest, a frame an iteration, to write: pc2, mdd or glb"},
      {"subdivide", cloth, everyone, OrAuto{&job.subdivide}, between(0, 6),
       "refine the garment so many times (Loop), 0 to 6; auto (the default): as often as its edges need to "
       "keep the gap, up to some 60,000 vertices; 0 for a garment with a rest state of its own"},
      {"finest", cloth, everyone, &s.finest, positive,
       "in place of `subdivide`: refine where cloth folds or is pressed together, until its edges are about "
       "so "
       "long there [m], and nowhere else; up to some 20,000 vertices (0.004 shows the folds of a shirt)"},
      {"bending_friction", cloth, few, &s.bending_friction, not_negative,
       "moment that a metre of crease bears before it gives way [N] (default 0; half of Kawabata's 2HB)"},
      {"made_for", body, everyone, &s.made_for,
       "body that the garment was made for and lies about, in its unit: it is brought from there to `body` "
       "first, turned with arms and legs; its size stays"},
      {"band", body, everyone, band_list(s.bands),
       "elastic bands along border loops, and their lengths over the loops', in (0, 2]: top=0.9"},
      {"band_stiffness", body, few, &s.band_stiffness, not_negative,
       "force in a band at twice its length [N]"},
      {"self_contact", rest, everyone,
       choice(
           s.self_contact,
           {{"auto", SelfContactUse::automatic}, {"on", SelfContactUse::on}, {"off", SelfContactUse::off}}),
       "whether cloth keeps off cloth. auto: where that ends blocked, torn or not at rest, the garment is "
       "draped again without, and the better end is taken; with `plain`, auto is off"},
      {"loose", rest, everyone,
       choice(s.loose, {{"hold", LooseUse::hold}, {"drop", LooseUse::drop}, {"fall", LooseUse::fall}}),
       "parts that neither the body nor a pin holds: hold lets them lie aside, and carries them with the "
       "nearest cloth; drop takes them out; fall drapes them as the rest"},
      {"budget", rest, everyone, &job.budget, endless,
       "processor time after which the best state so far is the end, which is no success [s]"},
      {"touches", rest, few, &s.touch_file,
       "what a hand does to it before, as a file (.json): iron, steam, pinch, pull (docs/tailor.md)"},
      {"residual", rest, few, &s.residual, positive,
       "largest net force on a vertex, over its weight, at which it rests"},
      {"contact_depth", rest, few, &s.contact_depth, between(1e-7, 1),
       "go on until nothing lies deeper in the gap than this [m]: 1e-6 gives tight cloth its full strain, in "
       "about twice the time (default: usually some 0.1 mm)"},
      {"cloth_thickness", rest, few, &s.thickness, between(1e-5, 0.05),
       "of the cloth, with `self_contact`: layers are so far apart [m] (default the scene's, else 0.001)"},
      {"penetration", rest, few, &s.penetration, not_negative,
       "depth to which the body may come through the cloth without failure [m]"},
      {"plain", rest, few, &s.plain,
       "paper 2's own scheme: forces used as displacements, with a cap; to compare with"},
      {"max_iterations", rest, few, &s.iterations, not_negative,
       "at most, on each level (default 200, with contact of cloth with cloth 1000; with `plain` 20000)"},
      {"fabrics", picture, everyone, Listed{&job.fabrics},
       "the same garment in each of these fabrics: the program takes them separated by commas, and draws "
       "them in one picture"},
  };
}

bridge::DrapeOptions drape_options_of(const io::Scene& scene, const DrapeSettings& s, double gap) {
  bridge::DrapeOptions options;
  options.refinements = scene.subdivide;
  if (s.finest) options.where = {.finest = *s.finest};
  options.settle.gravity = scene.simulation.gravity;
  options.settle.friction = scene.simulation.friction;
  options.settle.tolerance = s.residual;
  if (s.contact_depth) options.settle.contact_depth = *s.contact_depth;
  options.settle.self.thickness = thickness_of(scene, s);
  options.settle.self.friction = scene.simulation.self.friction;
  options.plain = s.plain;
  options.bending_friction = s.bending_friction;
  options.settle.max_iterations = s.iterations.value_or(s.plain ? 20000 : options.settle.max_iterations);
  options.settle.gap = gap;
  options.settle.threads =
      scene.threads ? scene.threads : int(std::max(1u, std::thread::hardware_concurrency()));
  return options;
}

}  // namespace furrow::jobs
