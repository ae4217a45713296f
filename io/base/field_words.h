// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

/// Messages name what a user may set neutrally, between backticks, and each face has its own words for it:
/// the field of a job or a setting `cloth_thickness`, with a value `subdivide=1`, by its path in a scene
/// `body.tolerance=0.01`, of another job `furrow doctor repair`; `furrow keep` is a job as a whole.
namespace furrow::io {

struct NamedField {
  std::string job = {}, field = {}, value = {};  ///< "": none is named
};

/// The text with what `words` has for each field that it names.
std::string worded(const std::string& text, const std::function<std::string(const NamedField&)>& words);
/// The value with what `change` makes of each text in it.
nlohmann::ordered_json with_texts(nlohmann::ordered_json value,
                                  const std::function<std::string(const std::string&)>& change);

/// As an option of the program: --cloth-thickness; with a value --subdivide 1. For what calls the program,
/// and what notes such calls; messages name fields.
std::string flag_of(const std::string& field, const std::string& value = "");

}  // namespace furrow::io
