// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/mesh/mesh_file.h"

namespace furrow::io {

/// What a wrinkled mesh carries beside its maps, so that a simulation needs nothing else. Kept as comments
/// `furrow wrinkle {…}` (JSON in one line).
struct WrinkleRecord {
  struct Line {
    std::string name;
    double height = 0;           ///< k [m]
    double drawn_height = 0;     ///< [m]
    double smoothed_height = 0;  ///< [m]
    double base_height = 0;      ///< of the line before it was displaced; the two above are without it [m]
    std::optional<double> width = {};  ///< as asked for [m], as the next two [-]
    double sharpness = 0.5, press = 1;
  };
  double mean_structural_length = 0;  ///< r_avg of the mesh before any line [m]
  double mean_bending_length = 0;     ///< [m]
  double density = 0;                 ///< [kg/m^2]
  std::string options;                ///< the flags that made the last lines
  std::string unit = "m", up = "y";   ///< of the file's positions and rest lengths: m, cm, mm or inch; y or z
  std::vector<Line> lines;            ///< by line id
  std::string garment;                ///< the file that the last lines were drawn on; empty: not known
  std::string garment_hash;           ///< its content_hash()
  std::string strokes;  ///< the last lines as a stroke file's text (metres, y up); empty: not known
  std::string
      material;  ///< the scene's [material], as JSON, that it came to rest or moved with; empty: not known
  double contact_gap = 0;  ///< that it kept from a body then [m]; 0: not known
};

/// Of the lines by id: widths [m] (NaN: none), and presses [-].
std::vector<double> line_widths(const WrinkleRecord& record);
std::vector<double> line_presses(const WrinkleRecord& record);

void set_wrinkle_record(MeshFile& file, const WrinkleRecord& record);
/// The record, or nothing if the file has none. Fields of later versions that are not there keep their
/// defaults. Throws geometry::ContentError if it is damaged.
std::optional<WrinkleRecord> find_wrinkle_record(const MeshFile& file);
/// The same of the file of that name, which messages then begin with.
std::optional<WrinkleRecord> find_wrinkle_record(const MeshFile& file, const std::string& name);
/// The same from the first lines of a PLY or OBJ file; nothing for any other, also one that is not there.
std::optional<WrinkleRecord> read_wrinkle_record(const std::filesystem::path& path);

}  // namespace furrow::io
