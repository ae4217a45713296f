// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

namespace furrow::jobs {

/// In what unit, with what axis upwards, a garment and its body seem to be.
struct GuessedFrame {
  std::string unit = "m", up = "y";  ///< of m, cm, mm; y or z
  bool sure = true;   ///< a file says so, or nothing else would be a person's or a garment's size
  double height = 0;  ///< that of the body, else of the garment, then [m]
};

/// From what the files note, else from their size: a person is 0.8 to 2.3 m tall and 1.25 times as tall as
/// deep, a garment 0.25 to 2.3 m. `body` empty: there is none. Throws as io::read_mesh(). Cost: reading both.
GuessedFrame guess_frame(const std::filesystem::path& garment, const std::filesystem::path& body = {});

}  // namespace furrow::jobs
