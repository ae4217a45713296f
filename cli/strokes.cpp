// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "io/base/lower_case.h"
#include "io/stroke/stroke_file.h"
#include "jobs/read_inputs.h"
#include "jobs/stroke_list.h"

namespace furrow::cli {
namespace {

struct StrokesArguments : CommonArguments {
  std::string in, garment;
  std::vector<std::string> remove, move, height, width, sharpness, press, rename;
  std::vector<std::string> taper, flare, smooth, rest_angles;
  std::string order;
  bool in_space = false;
};

std::string ending_of(const std::string& path) {
  return io::lower_case(std::filesystem::path(path).extension().string());
}

/// NAME=VALUE, parted at the last '='.
std::pair<std::string, std::string> parted(const std::string& text, const std::string& option) {
  const auto at = text.rfind('=');
  if (at == std::string::npos || at + 1 == text.size())
    throw UsageError(option + " takes NAME=VALUE, not '" + text + "'");
  return {text.substr(0, at), text.substr(at + 1)};
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
  const auto set = [&](const std::vector<std::string>& texts, const std::string& option, const auto& give) {
    for (const std::string& text : texts) {
      const auto [name, value] = parted(text, option);
      geometry::Stroke& stroke = named(name).stroke;
      if (option == "--width" && value == "none")
        stroke.width.reset(), stroke.widths.clear(), stroke.sharpness.reset();
      else
        give(stroke, parse_numbers(value, 1, option + " " + name)[0]);
    }
  };
  set(a.height, "--height",
      [](auto& stroke, double value) { stroke.height = value, stroke.heights.clear(); });
  set(a.width, "--width", [](auto& stroke, double value) { stroke.width = value, stroke.widths.clear(); });
  set(a.sharpness, "--sharpness", [](auto& stroke, double value) { stroke.sharpness = value; });
  set(a.press, "--press", [](auto& stroke, double value) { stroke.press = value; });
  set(a.smooth, "--smooth", [](auto& stroke, double value) { stroke.smooth = value; });
  set(a.rest_angles, "--set", [](auto& stroke, double value) { stroke.set = value; });
  for (const std::string& text : a.taper) {
    const auto [name, value] = parted(text, "--taper");
    geometry::Stroke& stroke = named(name).stroke;
    const bool two = value.find(',') != std::string::npos;
    const std::vector<double> lengths = parse_numbers(value, two ? 2 : 1, "--taper " + name);
    stroke.taper = {lengths.front(), lengths.back()};
  }
  for (const std::string& text : a.flare) {
    const auto [name, value] = parted(text, "--flare");
    if (value != "yes" && value != "no" && value != "usual")
      throw UsageError("--flare " + name + " takes yes, no or usual, not '" + value + "'");
    named(name).stroke.flare = value == "usual" ? std::nullopt : std::optional(value == "yes");
  }
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
  if (ending_of(a.in) != ".json") refuse_same(a.out, a.in);
}

void strokes(StrokesArguments a) {
  bool edits = !a.order.empty();
  for (const auto* list : {&a.remove, &a.move, &a.height, &a.width, &a.sharpness, &a.press, &a.rename,
                           &a.taper, &a.flare, &a.smooth, &a.rest_angles})
    edits = edits || !list->empty();
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

}  // namespace

void add_strokes(CLI::App& app) {
  auto a = std::make_shared<StrokesArguments>();
  CLI::App* sub = app.add_subcommand(
      "strokes",
      "List and change strokes; those of a wrinkled PLY can be written as a file\n\n"
      "  furrow strokes lines.json --garment shirt.obj\n"
      "  furrow strokes lines.json --move fold=0,0.02,0 --height hem=-0.01 -o lines.json\n"
      "  furrow strokes lines.json --width fold=0.06 --sharpness fold=0.2 --order hem,fold -o lines.json\n"
      "  furrow strokes wrinkled.ply --remove fold -o lines.json");
  sub->add_option("strokes", a->in, "strokes: JSON, the l elements of an OBJ file, or a wrinkled PLY")
      ->required();
  sub->add_option("-o,--output", a->out, "JSON to write");
  sub->add_option("--garment", a->garment, "lay them on this garment, and tell their lengths there [m]");
  sub->add_flag("--in-space", a->in_space, "write the strokes as points in space, as they lie on --garment");
  const auto several = [&](const char* name, auto& value, const char* help) {
    sub->add_option(name, value, help)->allow_extra_args(false);
  };
  several("--remove", a->remove,
          "NAME: take this stroke out; may be given several times, as all that follow");
  several("--move", a->move,
          "NAME=dx,dy,dz [m, y up], or =dx,dy in the pixels or texture that it is drawn in");
  several("--height", a->height, "NAME=height [m]; > 0 ridge, < 0 valley");
  several(
      "--width", a->width,
      "NAME=width of the whole fold [m], > 0; =none: rule fold chooses it, with the others it is as wide as "
      "the smoothing of the mesh makes it");
  several("--sharpness", a->sharpness, "NAME=sharpness of its crest [0, 1]; 0 round, 1 a tent");
  several("--press", a->press, "NAME=factor on the stiffness of its hinges, >= 1");
  several("--taper", a->taper,
          "NAME=length over which the fold rises at an end, or =begin,end [m]; rule fold, as what follows");
  several("--flare", a->flare, "NAME=yes, no or usual: it rises from end to end (usual: towards a border)");
  several("--smooth", a->smooth, "NAME=smoothing of the line as drawn, in tenths of the width; 0: none");
  several("--set", a->rest_angles, "NAME=share of the fold's angles that becomes rest angle [0, 1]");
  several("--rename", a->rename, "NAME=OTHER");
  sub->add_option(
      "--order", a->order,
      "NAME,NAME,...: these come first, in this order, the others after them (where lines meet the "
      "later one owns what they share); by their new names");
  add_common_options(*sub, *a);
  sub->callback([a] { strokes(*a); });
}

}  // namespace furrow::cli
