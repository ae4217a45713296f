// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "jobs/sketch/sketch.h"

/// A drawing as a project keeps it: {"settings": a scene's, "lines": [{"on": true, "stroke": {...}}, ...],
/// "earlier": names of lines that are in the cloth already, "motion": {...}, "middle": x, "made_for": a path
/// from the project's folder, as long as the cloth lies about that body and not about the scene's}.
namespace furrow::studio {

using jobs::Json;

/// What is wrong with the form of a drawing from a file, in words; "": nothing. Whether settings and strokes
/// can be used is seen where they are.
std::string fault_of_drawing(const Json& drawing);

jobs::SceneInput scene_of_drawing(const Json& drawing, const std::filesystem::path& folder);
Json drawing_of(const Json& settings, const Json& strokes);
/// The strokes of those lines that are on.
Json strokes_on(const Json& drawing);
std::string name_of_line(const Json& line);
/// What the list shows of a line.
Json row_of(const Json& line);
/// What a line of this stroke's kind is called: "ridge", "valley", "gather".
std::string word_of(const Json& stroke);
/// "ridge 3": no line of the drawing is called so, now or earlier.
std::string free_name(const Json& drawing, const std::string& word);
/// The same for a line of this stroke's kind.
std::string free_name_for(const Json& drawing, const Json& stroke);
/// The body that the cloth lies about, if another one is to wear it; else empty.
std::filesystem::path made_for_of(const Json& drawing, const std::filesystem::path& folder);
/// A drawing notes it; empty: none.
void note_made_for(const std::filesystem::path& body, const std::filesystem::path& folder, Json& drawing);
/// The garment of a drawing, before its lines. Throws as jobs::open_sketch().
jobs::Sketch open_drawing(const Json& drawing, const std::filesystem::path& folder, jobs::Listener& listener);
/// The mesh of a file in the project's folder takes the garment's place, and the lines that are on are in it.
void take_as_garment(const std::string& file, const Json& pins, Json& drawing);

/// What a drawing notes of its motion once it was played from `before` on to a time [s]: `state` names the
/// file to go on from, `pulled` says that a hand was in it.
Json motion_after(const Json& before, const std::string& state, double time, bool pulled);
/// The motion that a scene can do again; none: it does not move, a hand was in it, or settings were changed.
std::optional<jobs::SketchMotion> motion_of(const Json& drawing);

}  // namespace furrow::studio
