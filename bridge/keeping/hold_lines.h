// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "bridge/keeping/keep.h"

namespace furrow::bridge {

/// What drawn lines are held by.
struct HeldLines {
  physics::Cloth cloth;         ///< with its rest state, at rest
  KeptShape shape;              ///< of that
  std::vector<double> presses;  ///< by line id [-]
};

/// A garment's cloth, gathered with these presses of its lines by id and pinned.
using PressedCloth = std::function<physics::Cloth(const std::vector<double>& presses)>;

/// The least of the options' presses above one; none: it is the strongest.
std::optional<double> next_press(double press, const KeepOptions& options);

/// Finds the rest state with which a garment is in equilibrium as drawn (keep_shape()), and the least press
/// of its lines with which none of them takes part in a motion that nothing holds back. A line begins with
/// its options.line_presses, and goes on to the next of options.presses. Where no pins carry the garment,
/// nothing can be said before it rests: its lines get the first press at least. No body is a load.
/// Nothing runs, and no struts are added: whether the lines stand is for a search for rest to say
/// (bridge/draping/drape.h). mesh: as for keep_lines(). Without lines it is keep_shape(). Cost: a
/// factorisation or two for each press that is tried. Throws as keep_shape() and require_legal() do.
HeldLines hold_lines(const geometry::Mesh& mesh, const PressedCloth& make, const KeepOptions& options);

}  // namespace furrow::bridge
