// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/fold/wrinkle.h"
#include "jobs/base/ends.h"
#include "jobs/base/inputs.h"
#include "jobs/draw/shown_mesh.h"

namespace furrow::geometry {
struct CrossingMemory;
}

/// What an interactive program asks for while somebody draws on a garment. Its strokes are JSON, each as one
/// of a stroke file (io/stroke/stroke_file.h), so that what is not looked at is kept. Metres, y up.
namespace furrow::jobs {

/// A garment before its lines, what it lies on, and how lines are drawn on it.
struct Sketch {
  SceneInput scene;      ///< settings; the first round of lines at time 0 is the one that is drawn
  Frame frame;           ///< of the files
  io::MeshFile garment;  ///< before its lines [m]
  std::optional<io::MeshFile> body;  ///< that the garment lies about, at time 0 [m]
  std::filesystem::path made_for;    ///< its file, if another body is to wear it: the scene's; else empty
  geometry::WrinkleOptions options;  ///< of its lines
  std::optional<double> density;     ///< of the cloth [kg/m^2]; none: as the garment notes, else the default
  std::vector<std::vector<int>> pins;
  std::shared_ptr<const CrossedStart> crossed;               ///< how the garment crosses itself
  std::shared_ptr<geometry::CrossingMemory> crossings = {};  ///< of the lines drawn last
};

/// Reads garment and body. `made_for`: body that the garment lies about, in its unit; empty: the scene's.
/// Throws std::invalid_argument for settings that cannot be, or that no studio draws by (several rounds at
/// time 0), geometry::ContentError for files that cannot be used.
Sketch open_sketch(const SceneInput& scene, Listener& listener, const std::filesystem::path& made_for = {});

/// For SceneInput::memory of all sketches of one program, so that a body is loaded once.
std::shared_ptr<BodyShelf> make_shelf();

/// Throws geometry::ContentError where the garment cannot be brought from the body that it was made for to
/// the scene's. Cost: what is found of two bodies, 0.3 to 0.8 s each; none without such.
void check_made_for(const Sketch& sketch, Listener& listener);

/// The strokes of the first round at time 0 as a list of JSON objects; of a scene without one, an empty list.
Json strokes_of(const Sketch& sketch, Listener& listener);

/// The settings with all paths relative to a folder, in a frame that says unit and axis.
Json settings_for(const Sketch& sketch, const std::filesystem::path& folder);

/// A garment with its lines, as it is shown.
struct SketchedGarment {
  io::MeshFile file;  ///< [m]
  ShownMesh shown;
  std::vector<std::string> told;  ///< warnings
};

/// Draws the strokes into the garment, as furrow wrinkle does with a file of them; without strokes it is the
/// garment as it was. Throws as jobs::wrinkle().
SketchedGarment draw_sketch(const Sketch& sketch, const Json& strokes, Listener& listener);

/// A garment that came to rest with its lines.
struct SketchAtRest {
  io::MeshFile file;                 ///< [m]
  std::string outcome;               ///< "at rest", or what else
  std::vector<std::string> remarks;  ///< of what is wrong with it; empty: it is whole and at rest
};

/// Lets it come to rest on the scene's body, hung from the pins, or both, as furrow wrinkle --settle does,
/// and furrow drape where there are no strokes. What was made for another body is brought there. Throws as
/// these, and physics::Cancelled, if the listener cancels.
SketchAtRest drape_sketch(const Sketch& sketch, const Json& strokes, Listener& listener);

/// A garment at rest that was touched.
struct TouchedSketch {
  io::MeshFile file;      ///< [m]
  std::string kind;       ///< "iron"
  double moved;           ///< the farthest way of a vertex [m]
  bool balances;          ///< the cloth there came to rest
  std::size_t crossings;  ///< pairs of its faces that cross since
};
/// Does a touch, as one of a file's (io/stroke/touch_file.h; metres, y up), to the garment, and lets the
/// cloth around it come to rest; all farther cloth stays. Throws as jobs::touch(), and physics::Cancelled.
TouchedSketch touch_sketch(const Sketch& sketch, const Json& touch, Listener& listener);

/// Writes scene.toml, strokes.json and shape.ply, each whole or not at all, into a folder that is there; the
/// first is what furrow simulate, the second what furrow wrinkle reads. Names what was written.
std::vector<std::string> save_sketch(const Sketch& sketch, const Json& strokes,
                                     const std::filesystem::path& folder, Listener& listener);

/// How a sketch has moved since it began to.
struct SketchMotion {
  Json settings;                                ///< as it began, paths relative to the folder
  std::vector<std::pair<double, Json>> rounds;  ///< strokes, and when they were drawn [s]
  double time = 0;                              ///< until when it moved [s]
  double longest = 600;                         ///< of all plays, of which the step is a share [s]
};

/// Writes motion.toml, by which furrow simulate moves it again, and a stroke file for each of its rounds,
/// into a folder that is there. Where the files are in metres, y up, it comes to the same bits; elsewhere
/// strokes are rounded on their way through the file. Names what was written.
std::vector<std::string> save_motion(const SketchMotion& motion, const Frame& frame,
                                     const std::filesystem::path& folder);

/// Writes the mesh as PLY in the sketch's frame.
void write_sketched(const Sketch& sketch, const io::MeshFile& file, const std::filesystem::path& path,
                    Listener& listener);

/// Positions and faces, to the last bit: equal for equal shapes alone.
std::string shape_bits(const io::MeshFile& file);

/// A fabric that there is, and what it is like: "120 g/m², soft".
struct FabricChoice {
  std::string name, words;
};

/// All of them. Words go by the bending length (B / (density g))^(1/3), by which cloth falls in large or
/// small folds (Peirce 1930): flowing below 14 mm, soft below 23, firm below 28, else stiff.
std::vector<FabricChoice> fabric_choices();

}  // namespace furrow::jobs
