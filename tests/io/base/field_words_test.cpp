// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/field_words.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace furrow;

namespace {

std::string parts(const std::string& text) {
  return io::worded(text, [](const io::NamedField& named) {
    return "<" + named.job + "|" + named.field + "|" + named.value + ">";
  });
}

}  // namespace

TEST_CASE("field words: a message's fields, values and jobs get the words of a face") {
  CHECK(parts("name `body`, or try `self_contact=on`") == "name <|body|>, or try <|self_contact|on>");
  CHECK(parts("`furrow keep` helps; `furrow doctor repair` closes them") ==
        "<keep||> helps; <doctor|repair|> closes them");
  CHECK(parts("`body.tolerance=1e-3`") == "<|body.tolerance|1e-3>");
  CHECK(parts("`section=chest=1.25`") == "<|section|chest=1.25>");
}

TEST_CASE("field words: what names no field stays as it is, with its backticks") {
  for (const char* text : {"", "no field", "`", "a `b", "``", "`My File.obj`", "`-o`"})
    CHECK(parts(text) == text);
  CHECK(parts("`Not one` `gap`") == "`Not one` <|gap|>");
}

TEST_CASE("field words: the texts of a report get them wherever they are, its keys and numbers do not") {
  const nlohmann::ordered_json report{{"`gap`", 1}, {"list", {"`gap`", {{"why", "see `gap`"}}}}};
  const nlohmann::ordered_json worded{{"`gap`", 1}, {"list", {"<|gap|>", {{"why", "see <|gap|>"}}}}};
  CHECK(io::with_texts(report, parts) == worded);
}

TEST_CASE("field words: a flag has dashes") {
  CHECK(io::flag_of("cloth_thickness") == "--cloth-thickness");
  CHECK(io::flag_of("subdivide", "1") == "--subdivide 1");
}
