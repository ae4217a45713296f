// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/chain/hold_drawn.h"

#include <fmt/format.h>

#include <algorithm>

#include "bridge/arrays/gather.h"
#include "bridge/arrays/store_rest_state.h"
#include "bridge/keeping/hold_lines.h"
#include "geometry/fold/gather_lines.h"
#include "jobs/chain/room_for_lines.h"
#include "jobs/cloth/lost_lines.h"
#include "jobs/cloth/pins.h"
#include "jobs/cloth/prepare_garment.h"
#include "jobs/cloth/scene_cloth.h"
#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"
#include "physics/cloth/pins.h"

namespace furrow::jobs {
namespace {

constexpr double least_kept = 0.8, most_kept = 1.25;  // shares of its height at which a line stands as drawn

bool stands(const LineReport& line) {
  return !line.kept || (*line.kept >= least_kept && *line.kept <= most_kept);
}

std::size_t count_off(const Draped& d) {
  return std::size_t(std::count_if(d.lines.begin(), d.lines.end(), [](const auto& l) { return !stands(l); }));
}

bool is_better_held(const Draped& a, const Draped& b) {
  if (a.succeeds() != b.succeeds()) return a.succeeds();
  return count_off(a) < count_off(b);
}

/// Contact with the body is no load here: what is drawn lies off it, and a search for rest finds what
/// touches.
bridge::KeepOptions options_of(const io::Scene& scene, const io::WrinkleRecord& record) {
  bridge::KeepOptions options;
  options.run.gravity = scene.simulation.gravity;
  options.line_widths = io::line_widths(record);
  options.line_presses = io::line_presses(record);
  options.flat_lines = io::flat_lines(record);
  if (scene.body) options.largest_turn = 0;  // it would turn into the body
  return options;
}

/// Holds the lines of a garment as it lies, and rests it.
class Holder {
 public:
  Holder(const io::MeshFile& drawn, const io::Scene& scene, const BodyCollider* body)
      : drawn_(drawn),
        scene_(scene),
        body_(body),
        record_(*io::find_wrinkle_record(drawn)),
        options_(options_of(scene, record_)) {}

  /// until: processor time of the budget by which what is drawn must balance, else it falls [s].
  Draped rest(const Budget& budget, double until, const Context& context) {
    MemoryFiles memory = context.memory ? *context.memory : MemoryFiles{};
    memory.meshes[scene_.garment] = balanced(budget, until, context).value_or(drawn_);
    return drape_garment(scene_, body_, {}, false, {context.frame, context.listener, &memory});
  }

  /// More press for lines that do not stand; whether any got more.
  bool raise(const Draped& draped) {
    bool any = false;
    for (const LineReport& line : draped.lines) {
      if (stands(line) || line.id >= options_.line_presses.size()) continue;
      double& press = options_.line_presses[line.id];
      const auto next = bridge::next_press(press, options_);
      any = any || next;
      press = next.value_or(press);
    }
    return any;
  }

 private:
  std::optional<io::MeshFile> balanced(const Budget& budget, double until, const Context& context) {
    const ProgressScope progress(context.listener, "balancing what is drawn");
    progress(0);
    const physics::CancelScope in_time(
        [&] { return context.listener.cancelled() || budget.used_at_look() > until; });
    try {
      return held(context);
    } catch (const physics::Cancelled&) {
      if (context.listener.cancelled()) throw;
      context.warn(
          "lines_not_held",
          "to balance what is drawn took more than half of the budget that was left, so lines fall as "
          "they will; give it more with `budget`, or draw on a coarser garment",
          scene_.garment.string(), "`budget`");
      return std::nullopt;
    }
  }

  /// With its rest state, and the presses of its lines.
  io::MeshFile held(const Context& context) {
    io::MeshFile file = drawn_;
    complete_garment(file, scene_.material);
    const std::vector<geometry::Strut> threads =  // what they gather is not drawn
        geometry::cut_undrawn_threads(file.mesh, io::gathered_lines(record_));
    SilentListener silent(context.listener);  // the search for rest warns of pins and faces
    const auto pins = find_pins(file, scene_.pins);
    const auto pressed = [&](const std::vector<double>& presses) {
      note_presses(presses, file);
      return cloth_of(file, scene_, pins, nullptr, 0, {context.frame, silent});
    };
    bridge::HeldLines held = bridge::hold_lines(file.mesh, pressed, options_);
    options_.line_presses = held.presses;
    bridge::scatter(held.cloth.particles, file.mesh);
    physics::soften_clamps(held.cloth);
    bridge::store_rest_state(held.cloth, spring_options(file, scene_.material), file.mesh);
    geometry::sew(file.mesh, threads);
    return file;
  }

  void note_presses(const std::vector<double>& presses, io::MeshFile& file) {
    for (std::size_t i = 0; i < std::min(presses.size(), record_.lines.size()); ++i)
      record_.lines[i].press = presses[i];
    io::set_wrinkle_record(file, record_);
  }

  const io::MeshFile& drawn_;
  const io::Scene& scene_;
  const BodyCollider* body_;
  io::WrinkleRecord record_;
  bridge::KeepOptions options_;
};

}  // namespace

bool can_hold_lines(const io::SceneMaterial& material) {
  return material.bending_law == bridge::Bending::hinge || material.bending_law == bridge::Bending::plate;
}

Draped hold_drawn(const io::MeshFile& drawn, const io::Scene& scene, const BodyCollider* body,
                  const Budget& budget, const Context& context) {
  if (body && !body->made_for)
    if (const auto cramped = lines_without_room(drawn, body->exact, scene.simulation.contact_gap))
      context.listener.warn(*cramped);
  Holder holder(drawn, scene, body);
  double began = budget.used();
  Draped best = holder.rest(budget, (began + budget.seconds()) / 2, context), last = best;
  SilentListener silent(context.listener);  // the first one warned
  const Context quiet{context.frame, silent, context.memory};
  while (!last.report.stopped && last.end.finite && holder.raise(last)) {
    const double used = budget.used(), took = used - began;
    if (used + took > budget.seconds()) break;
    began = used;
    const ProgressScope progress(context.listener, "resting with more press");
    progress(0);
    try {
      last = holder.rest(budget, budget.seconds(), quiet);
    } catch (const physics::Cancelled&) {
      break;
    }
    if (!last.report.stopped && is_better_held(last, best)) best = last;
  }
  return best;
}

std::optional<Warning> low_lines(const std::vector<LineReport>& lines) {
  std::string told, first;
  std::size_t low = 0;
  for (const LineReport& line : lines) {
    if (!line.kept || *line.kept >= least_kept || *line.kept < lost_below) continue;
    const std::string name = line.name.value_or(std::to_string(line.id));
    if (++low == 1) first = name;
    told += fmt::format("{}'{}' {:.0f} %", told.empty() ? "" : ", ", name, 100 * *line.kept);
  }
  if (low == 0) return std::nullopt;
  return Warning{"lines_low",
                 fmt::format("{} of {} lines stand lower than they were drawn: {}; a stiffer "
                             "`fabric`, a lower or shorter line, or a pin at its end holds it",
                             low, lines.size(), told),
                 first, "`fabric`"};
}

}  // namespace furrow::jobs
