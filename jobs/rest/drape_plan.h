// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/body/world_body.h"
#include "jobs/rest/drape.h"
#include "jobs/rest/made_for.h"

/// What a drape of one garment, and one of several, have in common.
namespace furrow::jobs {

/// How the way to rest is looked for on a garment that was read.
struct DrapePlan {
  const io::Scene& scene;
  const BodyCollider* body;  ///< null: none
  const DrapeSettings& settings;
  const io::MeshFile& as_read;
  bridge::DrapeOptions options;
  std::span<const physics::Vec3> places = {};  ///< where it begins, by vertex [m]; empty: where it lies
};

/// How far a search for rest has come: the share of the way that its residual force has to fall, by
/// logarithm.
class WayToRest {
 public:
  explicit WayToRest(double tolerance) : tolerance_(tolerance) {}
  /// In [0, 1]; 0 while the force is as large as ever, or not finite.
  double share(const physics::SettleProgress& progress);

 private:
  double tolerance_, first_ = 0;
};

/// Whether a garment that nothing carries balances all the same, or is pulled by more than any cloth is.
/// (What falls lacks one weight.)
bool is_broken(const physics::SettleReport& last);

/// Of a garment's cloth [m].
double thickness_of(const io::Scene& scene, const DrapeSettings& settings);

/// With contact of cloth with cloth, whose piles take many steps to lie still.
void hold_apart(bridge::DrapeOptions& options, const DrapeSettings& settings);

/// gap: kept from the body [m].
bridge::DrapeOptions drape_options_of(const io::Scene& scene, const DrapeSettings& settings, double gap);

/// What is wanted, or what the sag and the field's tolerance need, from the inner side of cloth that has one
/// [m]; warns where that is much more.
double gap_of(const io::Scene& scene, const BodyCollider* body, const geometry::Mesh& garment,
              const Context& context);

/// That of the settings, else gap_of().
double gap_in_use(const io::Scene& scene, const BodyCollider* body, const DrapeSettings& settings,
                  const geometry::Mesh& garment, const Context& context);

/// The garment as it was given, and the scene with as many refinements as it is draped with.
struct GivenGarment {
  io::Scene scene;
  io::MeshFile file;
  std::optional<PlacedStart> placed = {};  ///< where it begins; none: where it lies

  std::span<const physics::Vec3> places() const {
    return placed ? std::span<const physics::Vec3>(placed->places) : std::span<const physics::Vec3>();
  }
};

/// `choose`: refined as often as the gap needs. Brought to the body from the one that it was made for, if
/// there is such; its own shape stays. Throws as reading does.
GivenGarment read_given(const io::Scene& scene, const BodyCollider* body, const DrapeSettings& settings,
                        bool choose, const Context& context);

/// What a garment that was draped has come to: `draped` has its file, its report and the ends of its parts.
/// One that its user cancels before is interrupted, and not measured: that takes a second at 131,000
/// vertices.
void measure_draped(const DrapePlan& plan, Draped& draped);

/// The same of one with parts that were held aside (a vertex of each): first they go with the other parts, as
/// rigid bodies.
void carry_and_measure(const DrapePlan& plan, std::span<const int> loose, Draped& draped);

/// Its facts, of what was measured: all that the judge of ends knows of a drape.
void take_facts(Draped& draped);

}  // namespace furrow::jobs
