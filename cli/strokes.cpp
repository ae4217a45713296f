// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <iostream>
#include <memory>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "geometry/errors.h"
#include "io/lower_case.h"
#include "io/resolve_strokes.h"
#include "io/stroke_file.h"
#include "io/wrinkle_record.h"

namespace furrow::cli {
namespace {

struct StrokesArguments : CommonArguments {
  std::string in, garment;
  std::vector<std::string> remove, move, height, rename;
  bool in_space = false;
};

std::string ending_of(const std::string& path) {
  return io::lower_case(std::filesystem::path(path).extension().string());
}

/// Of a stroke file, or those that a wrinkled mesh was made with.
std::vector<io::DrawnStroke> read(const StrokesArguments& a) {
  if (ending_of(a.in) != ".ply")
    return io::read_drawn_strokes(a.in, geometry::Stroke{}.height, read_options(a));
  const auto record = io::find_wrinkle_record(read_mesh(a.in, a));
  if (!record || record->strokes.empty())
    throw geometry::ContentError(a.in + ": holds no strokes; furrow wrinkle writes them into a PLY");
  return io::drawn_strokes_from(record->strokes, a.in);
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
  for (const std::string& text : a.height) {
    const auto [name, value] = parted(text, "--height");
    named(name).stroke.height = parse_numbers(value, 1, "--height " + name)[0];
  }
  for (const std::string& text : a.rename) {
    const auto [name, value] = parted(text, "--rename");
    named(name).stroke.name = value;
  }
}

Json to_json(const io::DrawnStroke& drawn) {
  Json item{{"name", drawn.stroke.name}, {"kind", io::kind_of(drawn)}, {"height", drawn.stroke.height}};
  if (const double length = io::drawn_length(drawn); std::isfinite(length))
    item["length"] = length, item["unit"] = io::unit_of(drawn);
  if (drawn.stroke.closed) item["closed"] = true;
  return item;
}

/// Strokes may take the place of the file that they were read from; nothing else may be replaced.
void check_output_name(const StrokesArguments& a) {
  if (a.out.empty() || a.out == "-") return;
  check_folder(a.out);
  refuse_same(a.out, a.garment);
  if (ending_of(a.in) != ".json") refuse_same(a.out, a.in);
}

void strokes(StrokesArguments a) {
  const bool edits = !a.remove.empty() || !a.move.empty() || !a.height.empty() || !a.rename.empty();
  if (a.out.empty() && (edits || a.in_space)) throw UsageError("changed strokes are written to -o");
  if (a.in_space && a.garment.empty())
    throw UsageError("--in-space needs --garment, which the strokes lie on");
  check_output_name(a);
  take_noted_frame(a, {a.in, a.garment});
  std::vector<io::DrawnStroke> list = read(a);
  edit(list, a);
  Json report{{"strokes", Json::array()}};
  for (const io::DrawnStroke& stroke : list) report["strokes"].push_back(to_json(stroke));
  if (!a.garment.empty()) {
    const io::ResolvedStrokes resolved = io::resolve_strokes(list, read_garment(a.garment, a));
    for (const std::string& w : resolved.warnings) warn(w, a);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const io::DrawnStroke in_space{resolved.strokes[i]};
      report["strokes"][i]["length_on_garment"] = io::drawn_length(in_space);
      report["strokes"][i]["parts"] = 1 + in_space.stroke.breaks.size();
      if (a.in_space) list[i] = in_space;
    }
  }
  if (!a.out.empty()) {
    const io::ReadOptions frame = read_options(a);
    const io::WriteOptions options{frame.metres_per_unit, frame.up};
    if (a.out == "-")
      io::write_strokes(std::cout, list, options);
    else
      io::write_strokes(std::filesystem::path(a.out), list, options);
    report["written"] = a.out;
  }
  print_report(report, a);
}

}  // namespace

void add_strokes(CLI::App& app) {
  auto a = std::make_shared<StrokesArguments>();
  CLI::App* sub =
      app.add_subcommand("strokes",
                         "List and change strokes; those of a wrinkled PLY can be written as a file\n\n"
                         "  furrow strokes lines.json --garment shirt.obj\n"
                         "  furrow strokes lines.json --move fold=0,0.02,0 --height hem=-0.01 -o lines.json\n"
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
  several("--rename", a->rename, "NAME=OTHER");
  add_common_options(*sub, *a);
  sub->callback([a] { strokes(*a); });
}

}  // namespace furrow::cli
