// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bridge/draping/drape.h"
#include "bridge/draping/fit_report.h"
#include "geometry/fold/touch.h"
#include "jobs/base/ends.h"
#include "jobs/cloth/shape_report.h"

namespace furrow::jobs {

/// An elastic band: a border loop's name, and its length over the loop's [-].
struct Band {
  std::string loop;
  double length;
};

/// Whether cloth keeps off cloth while it comes to rest.
enum class SelfContactUse {
  off,
  on,
  /// On, unless that ends where no cloth rests and without fewer faces cross, or as few.
  automatic
};

/// What becomes of parts that neither the body nor a pin holds.
enum class LooseUse {
  hold,  ///< they lie aside, and move as rigid bodies with the cloth that lay nearest
  drop,  ///< they lie aside, and are taken out of what is written
  fall   ///< they are draped as the rest is: they come to lie on cloth, with contact, or fall
};

/// A touch, and what it came to.
struct TouchReport {
  geometry::Touch touch;
  std::size_t vertices = 0;  ///< that it took hold of
  double moved = 0;          ///< the farthest way of one of them, the cloth around at rest [m]
  bool balances = false;     ///< it came to rest there
  double seconds = 0;        ///< that it took [s]
  /// Share of its change of shape that the garment at rest has kept [-]; none: it changed next to nothing.
  std::optional<double> remains;
  std::vector<physics::Vec3> before = {}, after = {};  ///< places of all vertices [m]
  std::vector<char> held = {};                         ///< by vertex: it took hold of it
  std::set<std::size_t> lines = {};                    ///< ids of lines that it took hold of
};

/// What draping knows beyond a scene.
struct DrapeSettings {
  bool plain = false;                                    ///< paper 2's own scheme
  double residual = physics::SettleOptions{}.tolerance;  ///< at which it rests [-]; > 0
  std::optional<double> contact_depth;  ///< that cloth may lie inside the gap [m]; none: no limit
  SelfContactUse self_contact = SelfContactUse::automatic;
  std::optional<double> thickness;  ///< of the cloth, with self_contact [m]; > 0; none: the scene's
  LooseUse loose = LooseUse::hold;
  double penetration = 0.005;     ///< depth to which the body may come through the cloth [m]; >= 0
  std::optional<int> iterations;  ///< on each level, >= 0; none: those of the method
  std::vector<Band> bands;
  double band_stiffness = 50;       ///< [N]; >= 0
  double bending_friction = 0;      ///< [N]; >= 0
  std::optional<double> finest;     ///< edges where cloth is refined [m]; > 0; none: it is refined everywhere
  std::filesystem::path animation;  ///< of the finest level, a frame an iteration; empty: none
  std::filesystem::path made_for;   ///< body that the garment lies about; empty: the scene's
  std::optional<double> gap;  ///< to the body, whatever edges and field need [m]; > 0; none: they raise it
  std::vector<geometry::Touch> touches = {};  ///< done to the garment before it comes to rest
  std::filesystem::path touch_file;           ///< with more of them (io/stroke/touch_file.h); empty: none
};

/// A garment to be put on the scene's body, hung from its pins, or both, under its material and gravity.
struct DrapeJob {
  SceneInput scene;  ///< with one garment, or several as a list (io/scene/garment_list.h)
  DrapeSettings settings = {};
  /// Refinements (Loop), in [0, 6]; none: the scene's, and if it says none, as many as the gap needs.
  std::optional<int> subdivide;
  /// Garments worn over those of the scene, the inner ones first, each a path or one in the scene's memory;
  /// all are draped together, none passing through another, and need a body. None: the scene's alone.
  std::vector<std::filesystem::path> over = {};
  std::vector<std::string> fabrics = {};  ///< the same garment in each; none: in the scene's, else what its
                                          ///< file notes, else cotton
  /// Mesh of a single fabric; empty or "-": not written. With garments over it: layer_output() of each.
  std::filesystem::path output;
  std::vector<std::string> more_outputs = {};  ///< files that the caller writes: none may replace another
  std::vector<std::string> more_inputs = {};   ///< files that the caller reads: none may be replaced
  double budget = 60;  ///< processor time after which the best state so far is the end [s]; > 0
};

/// Its options (jobs/base/card.h).
std::vector<CardRow> card(DrapeJob& job);

/// A number of a garment at rest, by the name that it has in reports; SI units.
struct RestNumber {
  std::string name;
  double value;
};

/// One of several rests that were looked for, each from a start of its own.
struct DrapeStart {
  std::uint64_t seed = 0;                  ///< bridge::DrapeOptions::seed
  std::string outcome;                     ///< as Draped::outcome()
  bool rests = false;                      ///< without, it counts in no spread
  Badness badness = {};                    ///< of its end
  double residual = 0;                     ///< [-]
  int iterations = 0, factorisations = 0;  ///< of all levels
  double seconds = 0;                      ///< [s]
  bridge::EnergyParts energy;
  std::vector<RestNumber> numbers;
};

/// A number over the starts that came to rest.
struct NumberSpread {
  std::string name;
  int count = 0;  ///< starts that know it
  double mean = 0;
  double deviation = 0;  ///< standard deviation (n - 1); 0 for one
  double least = 0, most = 0;
};

/// Several rests of one garment, and what they tell of its numbers.
struct DrapeStarts {
  int asked = 0;
  std::size_t chosen = 0;  ///< in `runs`: the best end; of equal ones that of the lowest energy (within
                           ///< 1e-6 of it, the first)
  std::vector<DrapeStart> runs;
  std::vector<NumberSpread> spread;
  /// Starts that came to rest.
  int resting() const;
};

/// The forces on a garment at rest, which add up to none: its weight, what each pin holds, and the contact
/// with the body and with other garments [N]. Parts that nothing holds, and friction of bending, are left
/// out.
struct DrapeForces {
  struct Pin {
    std::string name;  ///< of its loop or group, else "box" or "vertices"
    physics::Vec3 force;
  };
  struct Pull {
    std::string loop;
    double tension;  ///< a mean over the band
  };
  physics::Vec3 weight = physics::Vec3::Zero(), contact = physics::Vec3::Zero();
  std::vector<Pin> pins = {};
  std::vector<Pull> bands = {};
};

/// A search for rest, of two with contact of cloth with cloth and without, whose end was not taken.
struct DrapeOther {
  bool self_contact = false;                ///< cloth kept off cloth
  std::string outcome;                      ///< as Draped::outcome()
  std::size_t crossings = 0;                ///< pairs of faces of the cloth that cross
  int iterations = 0;                       ///< of all levels
  double residual = 0;                      ///< [-]
  double seconds = 0;                       ///< [s]
  std::optional<physics::Vec3> blocked_at;  ///< [m]
};

/// What is told of parts that nothing holds.
struct LooseParts {
  LooseUse use = LooseUse::hold;
  std::size_t vertices = 0;  ///< as they were given
  double area_share = 0;     ///< of the garment's area
};

/// How a garment was brought from the body that it was made for to the one that it is draped on.
struct Placed {
  struct Limb {
    std::string name;            ///< of the wearer's: "left arm"
    std::optional<double> turn;  ///< from how it was held [degrees]; none: a body's arm was not found
    double share = 0;            ///< of the garment's vertices that go with it, in [0, 1]
  };
  std::string made_for;                     ///< file of that body
  double height_scale = 1;                  ///< height of the body over that one's [-]
  std::array<Limb, 4> limbs;                ///< left and right arm, left and right leg
  double mean_move = 0, farthest_move = 0;  ///< of vertices [m]
  std::size_t inside = 0;                   ///< vertices inside the body then, before they are pushed out
  double inside_share = 0;                  ///< of all [-]
  double deepest = 0;                       ///< of them [m]
};

/// A garment that was draped.
struct Draped {
  io::MeshFile file;  ///< [m], y up, with the columns of its fit
  bridge::DrapeReport report;
  bridge::FitReport fit;
  bridge::FitOptions fit_options;
  int refinements = 0;                ///< Loop subdivisions of the garment as it was given
  std::optional<double> hem_height;   ///< mean y of the lowest border [m]; none: there is no border
  std::optional<DrapeStarts> starts;  ///< none: there was one
  std::vector<TouchReport> touches;   ///< in their order
  std::optional<Placed> placed;       ///< none: it was draped where it lay
  DrapeForces forces;                 ///< none of a garment that was cancelled
  double angle_defect = 0;  ///< how knobbly it rests: sum over inner vertices over the area [rad/m^2]
  std::vector<LineReport> lines = {};  ///< heights against what they were, or the file's at its start
  double gap = 0;                      ///< that was to be kept from the body [m]; 0: there is none
  double wanted_gap = 0;               ///< that was asked for [m]; 0: there is none
  std::size_t too_near = 0; /**< vertices that keep less than nine tenths of a gap that was not raised, by
                                 more than the field's tolerance */
  EndFacts end;             ///< what the judge of ends knows of it
  EndLimits limits = {};    ///< what it was allowed
  std::vector<std::string> loose = {};  ///< names of those that nothing holds
  LooseParts loose_parts = {};          ///< what was done with them
  bool animated = false;                ///< the animation was written
  double seconds = 0;                   ///< that the fit took, without reading and the body's field [s]
  std::string name;                     ///< of the garment, or of the fabric
  ClothCrossings crossings;             ///< of the cloth with itself, as it was given and now
  bool self_contact = false;            ///< cloth kept off cloth
  /// What that took apart where the garment crossed itself: at the start of the first level that it had to,
  /// left at the start of the last; rounds of all.
  physics::ContourReport untangled;
  std::optional<DrapeOther> other;        ///< none: one search was enough
  double thickness = 0;                   ///< of the cloth then [m]
  double cloth_friction = 0;              ///< Coulomb coefficient of cloth on cloth then [-]
  std::size_t crossings_with_others = 0;  ///< pairs of its faces and those of other garments that cross
  std::filesystem::path written;          ///< its file, where there are several garments
  bool budget_spent = false;              ///< that ended the search
  bool measured = false;                  ///< false: its user interrupted it; what is measured is not known

  /// Whether its forces balance where it was worn.
  bool rests() const { return end.rests(limits) && end.finite && !end.falls(); }
  /// Whether it keeps half as much again as the gap that was asked for, or more.
  bool floats() const { return gap > 1.5 * wanted_gap; }
  /// Whether the cloth passes through itself more often than was allowed.
  bool crosses_itself() const { return crossings.pairs > limits.crossings; }
  /// Whether it passes through other garments more often than was allowed.
  bool crosses_others() const { return crossings_with_others > limits.crossings; }
  /// Whether more is loose than a button or a scrap: over a twentieth of its area, unless that was dropped.
  bool falls_apart() const { return loose_parts.use == LooseUse::hold && loose_parts.area_share > 0.05; }
  /// Whether it is whole and at rest: not torn, not pierced, not crossing any cloth, not falling apart.
  bool succeeds() const { return jobs::succeeds(end, limits) && !falls_apart(); }
  /// "interrupted"; or "out of budget", else as outcome_of() its end, and what else is wrong.
  std::string outcome() const;
};

/// Two garments that are worn over each other.
struct LayerPair {
  std::string inner, outer;            ///< names
  bool touch = true;                   ///< false: they pass through each other, and that is no failure
  std::size_t crossings_at_start = 0;  ///< pairs of faces, one of each, that crossed as they were given
  std::size_t crossings = 0;           ///< now
  std::vector<CrossingPlace> places;   ///< now, most pairs first
  /// Vertices of the outer one within 2 cm of the inner one, and how many of them lie on its outer side
  /// (physics/pairs/layer_order.h); as given, and now.
  int compared_at_start = 0, outside_at_start = 0, compared = 0, outside = 0;

  /// Whether most of the outer garment lay inside the inner one as they were given.
  bool began_inside() const { return 2 * outside_at_start < compared_at_start; }
};

/// What is told of garments that were draped over each other.
struct DrapedLayers {
  std::vector<LayerPair> pairs;     ///< each two of them
  int edges_crossed = 0;            ///< edges through faces of another garment, each near rest by itself
  int edges_left = 0;               ///< of those that were not taken apart, on the last level
  int untangle_rounds = 0;          ///< of moves that took garments apart, on all levels
  double moved_most = 0;            ///< way of a vertex in them [m]
  std::vector<std::string> turned;  ///< names of garments whose faces look into the body
  double contact_energy = 0;        ///< with the body, and of all cloth with cloth [J]
};

/// What is to be said of the result; one that fails says why it is no success.
struct DrapeRemark {
  bool fails = false;
  Warning remark;
};

/// What jobs::drape() reached.
struct DrapeJobReport {
  std::vector<Draped> garments;        ///< in the order of the fabrics; the last one may have been cancelled
  std::optional<DrapedLayers> layers;  ///< of garments over each other, the inner ones first; none: no such
  std::vector<DrapeRemark> remarks;
  io::Scene scene;            ///< that was draped, in its first fabric
  Frame frame;                ///< of the file written
  bool budget_spent = false;  ///< that ended it

  bool cancelled() const { return garments.back().report.stopped; }
  bool fails() const;  ///< one does not succeed
};

/// Where one of several garments is written: "{}" in the name stands for the garment's ("worn/{}.ply" becomes
/// "worn/shirt.ply"); without, "worn.ply" becomes "worn-shirt.ply".
std::filesystem::path layer_output(const std::filesystem::path& output, const std::string& garment);

/// Finds how the garment comes to rest (bridge/draping/drape.h), measures how it fits, and writes the mesh,
/// whole or not at all. Where it is cancelled on the way, what was reached is returned and written. Throws
/// std::invalid_argument for a job that cannot be, geometry::ContentError for files that cannot be used,
/// physics::Cancelled (BudgetSpent, jobs/base/budget.h) before anything was found.
DrapeJobReport drape(const DrapeJob& job, Listener& listener);

/// A garment that was touched.
struct Touched {
  io::MeshFile file;  ///< [m], y up
  std::vector<TouchReport> touches;
  std::size_t crossings = 0;  ///< pairs of faces that cross since
};
/// The touches of a drape of one garment alone: cloth that they do not reach stays where it lies. Writes
/// nothing. Throws as drape(), and as touch_garment() does.
Touched touch(const DrapeJob& job, Listener& listener);

/// The report for programs, and what the command line prints, without the names of the files written.
Json to_json(const DrapeJobReport& report);
Json to_json(const Draped& garment);

}  // namespace furrow::jobs
