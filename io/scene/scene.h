// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bridge/arrays/gather.h"
#include "geometry/fold/wrinkle.h"
#include "physics/body/distance_field.h"
#include "physics/motion/simulate.h"

namespace furrow::io {

using Json = nlohmann::ordered_json;

/// A table without members.
geometry::Owned<Json> empty_table();

/// Settings as a tree, and where each came from. A path joins keys and indices with dots: "pins.0.box".
struct TomlDocument {
  geometry::Owned<Json> root = empty_table();
  std::map<std::string, std::string> where;  ///< by path: "scene.toml:12:5", or the flag that set it
  std::string name;                          ///< of the file, for messages

  /// Where the value, or the nearest table around it, was written.
  std::string place(const std::string& path) const;
  /// Whether the file says it, and not a flag.
  bool is_of_file(const std::string& path) const;
};

/// Reads a TOML file (version 1.0). Throws geometry::ContentError with file, line and column if it cannot be
/// read, is no TOML, or holds a date or a time, which no setting is.
TomlDocument read_toml(const std::filesystem::path& path);
/// The same from text; `name` stands in messages.
TomlDocument parse_toml(const std::string& text, const std::string& name);

/// A document of settings that were made elsewhere, all of them from `name`.
TomlDocument document_of(Json root, const std::string& name);
/// Where a table stands in place of a list of tables, makes it the list's only one.
void make_list(TomlDocument& document, const std::string& key);

/// Sets one value, making the tables and arrays on the way; an index may be at most one past an array's end.
/// Throws std::invalid_argument if the path runs through a value that is no table or array.
void set_value(TomlDocument& document, const std::string& path, Json value, const std::string& where);
/// A value as one would type it behind `key=`: TOML where it is such (numbers, true, [1, 2], {a = 1},
/// "text"), else a string as it stands.
Json parse_value(const std::string& text);
/// The value as TOML in one line, so that parse_value() gives it back.
std::string value_text(const nlohmann::ordered_json& value);

/// A round of lines, drawn into the garment when the simulation's clock shows `time`.
struct SceneLines {
  std::filesystem::path strokes;     ///< stroke file
  double time = 0;                   ///< [s]; >= 0; 0: before the simulation
  double height = 0.01;              ///< of strokes that name none [m]
  double fade = 0.3;                 ///< tau of the forces that insertion adds and that fade in [s]; > 0
  std::vector<std::string> without;  ///< names of strokes that are left out
  bool keep = false;                 ///< rest "keep": drawn, then the garment's shape is made its equilibrium
  geometry::WrinkleOptions options;
};

struct SceneBody {
  std::filesystem::path mesh;
  std::optional<std::string> unit;  ///< of its file and of its frames; none: that of all files
  std::filesystem::path cache;      ///< folder where what is made of its file is kept; empty: nowhere
  std::filesystem::path frames;  ///< PC2, MDD or OBJ sequence of a body that changes its shape; empty: rigid
  double fps = 0;                ///< of frames whose file names no times [1/s]; 0: as the file says, else 25
  physics::DistanceFieldOptions options;
  bool depth_maps = false;  ///< of frames: their distance is asked from maps, and is not exact
  physics::RigidMotion motion;
};

struct SceneMaterial {
  std::string preset;             ///< name of a Fabric; what else is said goes before it
  bool by_default = false;        ///< nobody said what the cloth is, so that is the command's usual one
  std::optional<double> density;  ///< [kg/m^2]; none: that of the file, else 0.15
  double stiffness = 1000;        ///< k_std of the structural springs [N/m]
  double bending = 10;            ///< k_std of the bending springs [N/m]
  bridge::Membrane membrane = bridge::Membrane::paper;
  bridge::Bending bending_law = bridge::Bending::cross;
  std::optional<double> stretch;          ///< Y [N/m]; of springs: in place of stiffness
  double poisson = 0.3;                   ///< of triangles [-]
  double rigidity = 1e-5;                 ///< B of hinges [N m]
  std::optional<double> tension;          ///< c of tension [N/m]; none: tension_constant() of the stretch
  double compression = 0.2, shear = 0.2;  ///< of tension [-]
  bridge::MassRule mass_rule = bridge::MassRule::area;
  std::optional<double> line_stretch;  ///< EA of a chain's links [N]; none: the file's, else 1000
  std::optional<double> line_density;  ///< of a chain [kg/m]; none: the file's, else 0.01
  /// Where the warp of woven cloth runs: auto, none (the same in all directions), file, texture, texture-u,
  /// x, y, z, or a stroke file.
  std::string warp = "auto";
  /// Of woven cloth: Y1, Y2, G [N/m], B1, B2 and B of strips cut at 45 degrees [N m]. All or none.
  std::optional<double> warp_stretch, weft_stretch, thread_shear, warp_rigidity, weft_rigidity, bias_rigidity;
  double thread_poisson = 0;  ///< nu12 [-]

  /// Whether it has threads; stretch and rigidity are then for laws that know none.
  bool is_woven() const { return warp_stretch && warp != "none"; }
};

/// Vertices that are held, or moved. Several kinds may be named in one.
struct ScenePins {
  std::vector<double> box;      ///< x0, y0, z0, x1, y1, z1 [m]; empty: none
  std::string loop, group;      ///< a border loop: top, bottom or an index; a group's name
  std::vector<int> vertices;    ///< indices
  physics::RigidMotion motion;  ///< from their places at time 0
};

struct SceneOutput {
  std::filesystem::path mesh, state, inserted, smoothed, settled, animation, body;  ///< empty: not written
  double fps = 25;                   ///< of the animation [1/s]; > 0
  std::optional<double> checkpoint;  ///< clock time between two states on the way [s]; > 0; none: no such
};

/// Which parts of a garment go with other cloth that they lie on (jobs/cloth/attach_parts.h).
struct SceneAttach {
  bool on = true;  ///< those do that are found to; false: none, and no end is tied
  std::vector<std::string> parts = {},
                           free = {};  ///< these do in any case; these do not (jobs/base/part_names.h)
};

/// All that a simulation is made of; what a scene file, flags and a saved state say. Paths are as the program
/// can open them; SI units; y up.
struct Scene {
  std::string title;
  std::filesystem::path garment;
  int layer = -1;     ///< of several garments, from the inside to the outside; -1: by their place
  bool touch = true;  ///< of several garments, whether it touches the others
  SceneAttach attach = {};
  bool join = true;                   ///< seams that the garment's file leaves open are one (io/mesh/weld.h)
  std::optional<double> thickness;    ///< of the cloth, where layers and folds are kept apart [m]; none: 1 mm
  int subdivide = 0;                  ///< times that Loop subdivision is applied before the first line
  int allow_crossings = 0;            ///< pairs of faces that may cross at the end; >= 0
  bool keep = false;                  ///< the garment's shape at time 0 is made its equilibrium
  Eigen::Vector3d velocity{0, 0, 0};  ///< of what is not pinned, at time 0 after settling [m/s]
  std::optional<std::string> unit, up;  ///< of the mesh and stroke files
  std::vector<SceneLines> lines;        ///< by time
  std::optional<SceneBody> body;
  SceneMaterial material;
  std::vector<ScenePins> pins;
  physics::Wind wind;
  bool settle = false;                  ///< what is drawn at time 0 comes to rest before it moves
  physics::SimulateOptions simulation;  ///< with gravity, friction, damping
  std::optional<physics::Integrator>
      integrator;                 ///< none: chosen by what the cloth costs, when that is known
  int starts = 1;                 ///< of furrow drape, each with noise of its own; >= 1
  int threads = 0;                ///< 0: as many as the garment's size is worth
  std::optional<double> stop_at;  ///< [s]; the state then is kept, the plan goes on to simulation.seconds
  SceneOutput output;
};

}  // namespace furrow::io
