// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <regex>
#include <set>

#include "io/base/field_words.h"
#include "io/scene/settings_schema.h"
#include "run_furrow.h"

using namespace furrow;
using namespace furrow::tests;

namespace {

struct Literal {
  std::string place, text;
};

/// The texts of the sources below the faces, those beside each other joined.
std::vector<Literal> literals() {
  std::vector<Literal> all;
  const std::regex token(R"((?:"(?:\\.|[^"\\\n])*"\s*)+|//[^\n]*|'(?:\\.|[^'\\\n])*')");
  for (const char* folder : {"geometry", "physics", "bridge", "io", "jobs"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source_file(folder))) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      const std::string text = read_text(entry.path());
      for (std::sregex_iterator at(text.begin(), text.end(), token), end; at != end; ++at) {
        if (at->str()[0] != '"') continue;
        const std::string place = entry.path().filename().string() + ": " + at->str();
        all.push_back({place, std::regex_replace(at->str(), std::regex(R"("\s*")"), "")});
      }
    }
  return all;
}

/// What users of the program may set: the options of all subcommands, as fields, and paths of scenes.
std::set<std::string> settable() {
  std::set<std::string> fields{"scene"};
  for (const io::Setting& s : io::scene_settings()) fields.insert({s.path, s.keyword});
  const std::regex option(R"(--([a-z][a-z0-9-]*))"), command(R"(\n  ([a-z]+) )");
  const std::string all = run_furrow("--help").out;
  for (std::sregex_iterator sub(all.begin(), all.end(), command), end; sub != end; ++sub) {
    const std::string help = run_furrow((*sub)[1].str() + " --help-all").out;
    for (std::sregex_iterator at(help.begin(), help.end(), option); at != end; ++at) {
      std::string name = (*at)[1];
      std::replace(name.begin(), name.end(), '-', '_');
      fields.insert(name);
    }
    fields.insert("furrow " + (*sub)[1].str());
  }
  return fields;
}

}  // namespace

TEST_CASE("messages: below the faces none names a flag, and what one names can be set") {
  const std::set<std::string> known = settable();
  std::size_t named = 0;
  for (const Literal& literal : literals()) {
    INFO(literal.place);
    CHECK_FALSE(std::regex_search(literal.text, std::regex("--[a-z]")));
    if (literal.place.find("settings.cpp") + 1 || literal.place.find("settings_schema.cpp") + 1) continue;
    io::worded(literal.text, [&](const io::NamedField& field) {
      ++named;
      INFO(field.job << " " << field.field);
      CHECK((field.job.empty() || known.count("furrow " + field.job)));
      CHECK((field.field.empty() || known.count(field.field)));
      return "";
    });
  }
  CHECK(named > 100);
}

TEST_CASE("messages: the program names its flags") {
  const ScratchDirectory scratch;
  write_text(scratch / "square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  const std::string square = scratch / "square.obj";
  CHECK(run_furrow("drape " + square + " -o " + (scratch / "worn.ply")).err ==
        "error: a garment rests on a body or hangs from what holds it: name a body with --body, or what is "
        "held "
        "with --pin-loop, --pin-group, --pin-box or --pin-vertices\n");
  CHECK(run_furrow("chart " + square + " --set pins.0.loop=0 --set simulation.settle=true --csv " +
                   (scratch / "c.csv"))
            .err.find("say --set simulation.settle=false\n") != std::string::npos);
  CHECK(run_furrow("doctor " + square + " --unit mm")
            .out.find("with --unit mm; say --unit m if its file is in that\n") != std::string::npos);
}
