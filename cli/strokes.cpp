// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iostream>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "io/base/figure_path.h"
#include "io/stroke/stroke_file.h"
#include "jobs/base/read_inputs.h"
#include "jobs/draw/stroke_list.h"

namespace furrow::cli {
namespace {

struct StrokesArguments : CommonArguments {
  std::string in, garment;
  std::vector<std::string> remove, move, change, rename;
  std::string order;
  bool in_space = false;
};

/// NAME=VALUE, parted at the last '='.
std::pair<std::string, std::string> parted(const std::string& text, const std::string& option) {
  const auto at = text.rfind('=');
  if (at == std::string::npos || at + 1 == text.size())
    throw UsageError(option + " takes NAME=VALUE, not '" + text + "'");
  return {text.substr(0, at), text.substr(at + 1)};
}

struct Change {
  std::string name, key, value;
};

/// NAME.KEY=VALUE
Change change_of(const std::string& text) {
  static const std::vector<std::string> keys{"height", "width",  "sharpness", "press", "taper",
                                             "flare",  "smooth", "set",       "gather"};
  const auto [place, value] = parted(text, "--change");
  const auto at = place.rfind('.');
  const std::string key = at == std::string::npos ? "" : place.substr(at + 1);
  if (std::find(keys.begin(), keys.end(), key) == keys.end())
    throw UsageError(
        "--change takes NAME.KEY=VALUE, where KEY is height, width, sharpness, press, taper, flare, "
        "smooth, set or gather, not '" +
        text + "'");
  return {place.substr(0, at), key, value};
}

/// What is no single number: the width that goes, tapers, flares. False: it is one.
bool change_words(geometry::Stroke& stroke, const Change& c) {
  if (c.key == "width" && c.value == "none") {
    stroke.width.reset(), stroke.widths.clear(), stroke.sharpness.reset();
  } else if (c.key == "gather" && c.value == "none") {
    stroke.gather.reset();
  } else if (c.key == "taper") {
    const bool two = c.value.find(',') != std::string::npos;
    const std::vector<double> lengths = parse_numbers(c.value, two ? 2 : 1, "--change " + c.name + ".taper");
    stroke.taper = {lengths.front(), lengths.back()};
  } else if (c.key == "flare") {
    if (c.value != "yes" && c.value != "no" && c.value != "usual")
      throw UsageError("--change " + c.name + ".flare takes yes, no or usual, not '" + c.value + "'");
    stroke.flare = c.value == "usual" ? std::nullopt : std::optional(c.value == "yes");
  } else {
    return false;
  }
  return true;
}

/// Changes the stroke that `named` finds.
void change(const std::string& text, const auto& named) {
  const Change c = change_of(text);
  geometry::Stroke& stroke = named(c.name).stroke;
  if (change_words(stroke, c)) return;
  const double value = parse_numbers(c.value, 1, "--change " + c.name + "." + c.key)[0];
  if (c.key == "height")
    stroke.height = value, stroke.heights.clear();
  else if (c.key == "width")
    stroke.width = value, stroke.widths.clear();
  else if (c.key == "sharpness")
    stroke.sharpness = value;
  else if (c.key == "press")
    stroke.press = value;
  else if (c.key == "smooth")
    stroke.smooth = value;
  else if (c.key == "gather")
    stroke.gather = value;
  else
    stroke.set = value;
}

void edit(std::vector<io::DrawnStroke>& strokes, const StrokesArguments& a) {
  const auto named = [&](const std::string& name) -> io::DrawnStroke& {
    return strokes[io::find_stroke(strokes, name)];
  };
  for (const std::string& name : a.remove) strokes.erase(strokes.begin() + io::find_stroke(strokes, name));
  if (strokes.empty()) throw UsageError("--remove leaves no stroke to write");
  for (const std::string& text : a.move) {
    const auto [name, value] = parted(text, "--move");
    io::DrawnStroke& stroke = named(name);
    const bool in_space = std::holds_alternative<std::monostate>(stroke.on);
    io::move_stroke(stroke, parse_numbers(value, in_space ? 3 : 2, "--move " + name));
  }
  for (const std::string& text : a.change) change(text, named);
  check_shapes(strokes);
  for (const std::string& text : a.rename) {
    const auto [name, value] = parted(text, "--rename");
    named(name).stroke.name = value;
  }
  if (!a.order.empty()) io::order_strokes(strokes, CLI::detail::split(a.order, ','));
}

/// Strokes may take the place of the file that they were read from; nothing else may be replaced.
void check_output_name(const StrokesArguments& a) {
  if (a.out.empty() || a.out == "-") return;
  check_folder(a.out);
  refuse_same(a.out, a.garment);
  Terminal terminal(a);
  if (io::ending_of(a.in) != ".json" || !same_file(a.out, a.in)) check_replaced({a.out}, {a.in}, terminal);
}

Lines strokes_lines(const Json& report) {
  const Json& strokes = list_of(report, "strokes");
  Lines lines{counted(strokes.size(), "stroke")};
  for (const Json& stroke : strokes) {
    const std::string unit = text_of(stroke, "unit");
    std::string line = (text_of(stroke, "name").empty() ? "(no name)" : text_of(stroke, "name")) +
                       ": height " + length(stroke, "height");
    if (stroke.contains("gather")) line += ", gather to " + per_cent(value_of(stroke, "gather"));
    if (stroke.contains("width")) line += ", width " + length(stroke, "width");
    if (stroke.contains("length_on_garment"))
      line += ", " + length(stroke, "length_on_garment") + " long on the garment";
    else if (unit == "m")
      line += ", " + length(stroke, "length") + " long";
    line += ", drawn as " + text_of(stroke, "kind");
    if (stroke.value("closed", false)) line += ", closed";
    lines.push_back(line);
  }
  return lines;
}

void strokes(StrokesArguments a) {
  bool edits = !a.order.empty();
  for (const auto* list : {&a.remove, &a.move, &a.change, &a.rename}) edits = edits || !list->empty();
  if (a.out.empty() && (edits || a.in_space)) throw UsageError("changed strokes are written to -o");
  if (a.in_space && a.garment.empty())
    throw UsageError("--in-space needs --garment, which the strokes lie on");
  check_output_name(a);
  take_noted_frame(a, {a.in, a.garment});
  Terminal terminal(a);
  const Context context{a, terminal};
  std::vector<io::DrawnStroke> list = read_stroke_list(a.in, context), on_garment;
  edit(list, a);
  if (!a.garment.empty())
    on_garment = lay_on(list, jobs::read_garment(std::filesystem::path(a.garment), context), context);
  Json report{{"strokes", to_json(list, on_garment)}};
  if (a.in_space) list = on_garment;
  if (!a.out.empty()) {
    const io::ReadOptions frame = read_options(a);
    const io::WriteOptions options{frame.metres_per_unit, frame.up};
    if (a.out == "-")
      io::write_strokes(std::cout, list, options);
    else
      io::write_strokes(std::filesystem::path(a.out), list, options);
    report["written"] = a.out;
  }
  print_report(report, a, {strokes_lines(report), {a.out}});
}

void add_strokes(CLI::App& sub, StrokesArguments& a) {
  sub.add_option("strokes", a.in, "strokes: JSON, the l elements of an OBJ file, or a wrinkled PLY")
      ->required();
  sub.add_option("-o,--output", a.out, "JSON to write");
  sub.add_option("--garment", a.garment, "lay them on this garment, and tell their lengths there [m]");
  sub.add_flag("--in-space", a.in_space, "write the strokes as points in space, as they lie on --garment");
  const auto several = [&](const char* name, auto& value, const char* help) {
    sub.add_option(name, value, help)->allow_extra_args(false);
  };
  several("--remove", a.remove, "NAME: take this stroke out; may be given several times, as all that follow");
  several("--move", a.move,
          "NAME=dx,dy,dz [m, y up], or =dx,dy in the pixels or texture that it is drawn in");
  several(
      "--change", a.change,
      "NAME.height=VALUE [m], > 0 ridge, < 0 valley; NAME.width=VALUE [m], > 0, of the whole fold, or none: "
      "rule "
      "fold chooses it, with the others it is as wide as the smoothing of the mesh makes it; "
      "NAME.sharpness=VALUE of its crest [0, 1], 0 round, 1 a tent; NAME.press=VALUE, the factor on the "
      "stiffness "
      "of its hinges; and of rule fold NAME.taper=VALUE, or begin,end [m], over which it rises at an end, "
      "NAME.flare=yes, no or usual: it rises from end to end (usual: towards a border), NAME.smooth=VALUE of "
      "the "
      "line as drawn, in tenths of the width, 0: none, NAME.set=VALUE, the share of its angles that becomes "
      "rest "
      "angle [0, 1]; NAME.gather=VALUE, the share of its length that a thread draws it in to [0.1, 1], or "
      "none");
  several("--rename", a.rename, "NAME=OTHER");
  sub.add_option(
      "--order", a.order,
      "NAME,NAME,...: these come first, in this order, the others after them (where lines meet the "
      "later one owns what they share); by their new names");
}

const Subcommand strokes_subcommand(
    60, "strokes",
    "List and change strokes; those of a wrinkled PLY can be written as a file\n\n"
    "  furrow strokes lines.json --garment shirt.obj\n"
    "  furrow strokes lines.json --move fold=0,0.02,0 --change hem.height=-0.01 -o lines.json\n"
    "  furrow strokes lines.json --change fold.width=0.06 --order hem,fold -o lines.json\n"
    "  furrow strokes wrinkled.ply --remove fold -o lines.json",
    add_strokes, strokes);

}  // namespace
}  // namespace furrow::cli
