// SPDX-License-Identifier: GPL-3.0-or-later
// Mistakes that people make in their first week: each ends with its exit code and a sentence that helps.
#include <catch2/catch.hpp>
#include <regex>

#include "io/mesh/mesh_file.h"
#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow::tests;
namespace io = furrow::io;

namespace {

struct Mistake {
  const char* what;
  const char* call;  ///< {m}: the folder of our meshes; {d}: that of the test's own files
  int exit_code;
  const char* first_line;  ///< {formats}: those read and those written; {written}: the latter
};

const Mistake mistakes[] = {
    {"a subcommand misspelt", "wrinkel {m}/sheet.obj {m}/strokes/round_bulge.json -o {d}/o.ply", 2,
     "error: there is no subcommand 'wrinkel'; did you mean 'wrinkle'?"},
    {"a subcommand that there is not", "fold {m}/sheet.obj", 2,
     "error: there is no subcommand 'fold'; furrow --help lists them"},
    {"an option misspelt", "simulate {m}/sheet.obj --secnds 1 -o {d}/o.ply", 2,
     "error: --secnds: furrow simulate has no such option; did you mean --seconds?"},
    {"an option of another command", "info {m}/sheet.obj --seconds 2", 2,
     "error: --seconds: furrow info has no such option; furrow info --help tells more"},
    {"no mesh named", "wrinkle", 2, "error: mesh is required; furrow wrinkle --help tells more"},
    {"no output named", "smooth {m}/sheet.obj", 2,
     "error: --output is required; furrow smooth --help tells more"},
    {"strokes forgotten", "wrinkle {m}/sheet.obj -o {d}/o.ply", 2,
     "error: {m}/sheet.obj holds no strokes to draw again: name a file of strokes"},
    {"an output without an ending", "smooth {m}/sheet.obj -o {d}/out", 2,
     "error: {d}/out: the ending names no format that can be written; choose {written}"},
    {"an output in a format that is only read", "smooth {m}/sheet.obj -o {d}/o.gltf", 2,
     "error: {d}/o.gltf: a glTF is written as one file; let its name end in .glb"},
    {"an output in a folder that is not there", "smooth {m}/sheet.obj -o {d}/no/o.ply", 1,
     "error: {d}/no/o.ply: cannot be written, there is no folder {d}/no; make it first"},
    {"a picture that is no PNG", "render {m}/sheet.obj -o {d}/p.jpg", 2,
     "error: -o: {d}/p.jpg: pictures are written as PNG; let the name end in .png"},
    {"the output is the input", "smooth {d}/sheet.obj -o {d}/sheet.obj", 2,
     "error: {d}/sheet.obj: would replace {d}/sheet.obj; choose another name"},
    {"a mesh that is not there", "info {d}/shrit.obj", 3,
     "error: {d}/shrit.obj: cannot be opened: No such file or directory"},
    {"a mesh in a format that is not read", "info {d}/mesh.blend", 3,
     "error: {d}/mesh.blend: unknown format '.blend'; {formats}; export it as GLB or OBJ"},
    {"a folder in place of a mesh", "info {d}", 3, "error: {d}: is a folder; name a mesh in it"},
    {"an empty mesh", "info {d}/empty.obj", 3,
     "error: {d}/empty.obj: no faces; a mesh with at least one triangle is needed"},
    {"a broken line in an OBJ", "info {d}/bad.obj", 3,
     "error: {d}/bad.obj:2: 'zero' is not a number (coordinate of a vertex), correct it"},
    {"strokes given as the mesh", "wrinkle {m}/strokes/round_bulge.json {m}/sheet.obj -o {d}/o.ply", 2,
     "error: {m}/strokes/round_bulge.json: is a file of strokes; the garment comes first, then its strokes"},
    {"a mesh without lines given as the strokes", "wrinkle {m}/sheet.obj {m}/skirt.obj -o {d}/o.ply", 3,
     "error: {m}/skirt.obj: no polylines (l elements); export the lines too"},
    {"strokes that are no JSON", "wrinkle {m}/sheet.obj {d}/broken.json -o {d}/o.ply", 3,
     "error: {d}/broken.json:1:14: no valid JSON: syntax error while parsing value - unexpected end of "
     "input; expected '[', '{', or a literal; correct it"},
    {"strokes with an unknown key", "wrinkle {m}/sheet.obj {d}/key.json -o {d}/o.ply", 3,
     "error: {d}/key.json: stroke 0: unknown key 'hieght'; did you mean 'height'?"},
    {"strokes without points", "wrinkle {m}/sheet.obj {d}/nopoints.json -o {d}/o.ply", 3,
     "error: {d}/nopoints.json: stroke 0: 'points' is missing, or one of 'pixels', 'texture' and 'vertices'"},
    {"no stroke in the list", "wrinkle {m}/sheet.obj {d}/none.json -o {d}/o.ply", 3,
     "error: {d}/none.json: no strokes; add one to the list"},
    {"strokes in centimetres", "wrinkle {m}/sheet.obj {d}/cm.json -o {d}/o.ply", 3,
     "error: {m}/sheet.obj: the stroke, point 0: it is 52.7 m from the surface, more than the largest "
     "distance of 50 mm; check the unit (--unit), or raise --max-distance"},
    {"strokes far from the garment", "wrinkle {m}/sheet.obj {d}/far.json -o {d}/o.ply", 3,
     "error: {m}/sheet.obj: stroke \"fold\", point 0: it is 300 mm from the surface, more than the largest "
     "distance of 50 mm; check the unit (--unit), or raise --max-distance"},
    {"a width below 0", "wrinkle {m}/sheet.obj {d}/width.json -o {d}/o.ply", 3,
     "error: {d}/width.json: stroke 0: 'width' = -0.050000 must be > 0 (metres)"},
    {"a stroke left out that is not there",
     "wrinkle {m}/sheet.obj {m}/strokes/round_bulge.json --without rnig -o {d}/o.ply", 3,
     "error: there is no stroke 'rnig'; did you mean 'ring 1'?"},
    {"a height with a unit", "wrinkle {m}/sheet.obj {m}/strokes/round_bulge.json --height 10mm -o {d}/o.ply",
     2,
     "error: --height takes a number, not '10mm'; lengths are metres: write 0.01; furrow wrinkle --help "
     "tells more"},
    {"a unit that there is not", "info {m}/sheet.obj --unit metre", 2,
     "error: --unit: 'metre' is none of m, cm, mm, inch; furrow info --help tells more"},
    {"an axis that there is not", "info {m}/sheet.obj --up x", 2,
     "error: --up: 'x' is none of y, z; did you mean y?; furrow info --help tells more"},
    {"a garment in millimetres", "simulate {d}/mm.obj -o {d}/o.ply", 3,
     "error: {d}/mm.obj: the garment is 1700 m tall; if its file is not in metres, say so with --unit cm, mm "
     "or inch; --force takes it as it is"},
    {"a body in millimetres", "drape {m}/skirt.obj --body {d}/mm.obj -o {d}/o.ply", 3,
     "error: {d}/mm.obj: the body is 1700 m tall; if its file is not in metres, say so with --unit cm, mm or "
     "inch, or with --body-unit if only the body's is not; --force takes it as it is"},
    {"a body that is not there", "drape {m}/skirt.obj --body {d}/bdoy.obj -o {d}/o.ply", 3,
     "error: {d}/bdoy.obj: cannot be opened: No such file or directory"},
    {"the body forgotten", "drape {m}/skirt.obj -o {d}/o.ply", 2,
     "error: a garment rests on a body or hangs from what holds it: name a body with --body, or what is held "
     "with --pin-loop, --pin-group, --pin-box or --pin-vertices"},
    {"the distance to no body", "drape {m}/skirt.obj --pin-loop top --colour distance --picture {d}/o.png", 2,
     "error: --colour distance is that to a body: name one with --body"},
    {"nothing to write", "drape {m}/skirt.obj --body {m}/mannequin.obj", 2,
     "error: nothing to write: name --output, --picture or --animation"},
    {"a fabric misspelt", "simulate {m}/sheet.obj --fabric cottn -o {d}/o.ply", 2,
     "error: --fabric: material.preset = \"cottn\" is none of cotton, wool, silk, denim, interlock, jersey, "
     "rib-knit, jet-set, dots, target, black-denim, ivory-rib, brown-ribbon, white-dots, camel-ponte, "
     "gray-interlock, red-jet-set, polyester-twill, polyester-plain, wool-twill, viscose-twill, "
     "elastane-plain, "
     "cotton-twill; did you mean cotton?"},
    {"a depth below 0", "drape {m}/skirt.obj --body {m}/mannequin.obj --penetration -1 -o {d}/o.ply", 2,
     "error: --penetration takes a number, 0 or more, not -1; furrow drape --help tells more"},
    {"a height in centimetres", "body --height 168 -o {d}/o.obj", 2,
     "error: --height takes a number, 0.9 to 2.5, not 168; lengths are metres: write 1.68; furrow body "
     "--help "
     "tells more"},
    {"a plan without an action", "batch plan.toml", 2,
     "error: action: 'plan.toml' is none of list, parallel, slurm, gather, case, task; write furrow batch "
     "parallel plan.toml; furrow batch --help tells more"},
    {"a fabric without an action, misspelt", "fabric cottn", 2,
     "error: action: 'cottn' is none of list, show, drape, fit; did you mean furrow fabric show cotton?; "
     "furrow fabric --help tells more"},
    {"another program's file", "drape {d}/a.blend --body {m}/mannequin.obj -o {d}/o.ply", 3,
     "error: {d}/a.blend: unknown format '.blend'; {formats}; export it as GLB or OBJ"},
    {"a damaged file of another program", "info {d}/a.fbx", 3,
     "error: {d}/a.fbx: assimp reads no mesh from it: FBX-Tokenize (offset 0x0) file is too short; export it "
     "as "
     "GLB or OBJ"},
    {"a figure of a file that has none", "info {m}/skirt.obj#Skirt", 3,
     "error: {m}/skirt.obj#Skirt: unknown format "
     "'.obj#skirt'; {formats}"},
    {"a file that Git LFS did not bring", "info {d}/pointer.obj", 3,
     "error: {d}/pointer.obj: is a pointer of Git LFS, not the file itself; git lfs pull brings that"},
    {"an integrator misspelt", "simulate {m}/sheet.obj --integrator leapfrogg -o {d}/o.ply", 2,
     "error: --integrator: simulation.integrator = \"leapfrogg\" is none of auto, leapfrog, rk4, xpbd, "
     "implicit, tr-bdf2; did you mean leapfrog?"},
    {"an integrator that left", "simulate {m}/sheet.obj --integrator euler -o {d}/o.ply", 2,
     "error: --integrator: simulation.integrator = \"euler\" diverges at any step and is no choice any more; "
     "write leapfrog, which costs as much a step"},
    {"a time below 0", "simulate {m}/sheet.obj --seconds -1 -o {d}/o.ply", 2,
     "error: --seconds: simulation.seconds = -1 must be a number >= 0 [s]"},
    {"a step that is too long", "simulate {m}/sheet.obj --dt 1 --seconds 2 -o {d}/o.ply", 2,
     "error: simulate: dt = 1 s is above the stability limit of 0.00010409 s; take a shorter step, or leave "
     "dt out"},
    {"a pin of a loop that there is not", "simulate {m}/sheet.obj --pin-loop middle -o {d}/o.ply", 2,
     "error: border loop 'middle': choose top, bottom or an index from 0 to 0"},
    {"a pin of a vertex that there is not", "simulate {m}/sheet.obj --pin-vertices 99999 -o {d}/o.ply", 2,
     "error: pinned vertex 99999: the mesh has vertices 0 to 3037"},
    {"five numbers for a box", "simulate {m}/sheet.obj --pin-box 0,0,0,1,1 -o {d}/o.ply", 2,
     "error: --pin-box takes 6 numbers separated by commas, not '0,0,0,1,1'"},
    {"a setting that there is not", "simulate {m}/sheet.obj --set material.stifness=3 -o {d}/o.ply", 2,
     "error: --set: there is no setting 'material.stifness'; did you mean 'stiffness'?"},
    {"a setting without a value", "simulate {m}/sheet.obj --set material.stretch -o {d}/o.ply", 2,
     "error: --set takes key=value, not 'material.stretch'"},
    {"a scene with an unknown key", "simulate {d}/key.toml", 3,
     "error: {d}/key.toml:4:1: there is no setting 'material.strech'; did you mean 'stretch'?"},
    {"a scene whose garment is not there", "simulate {d}/missing.toml", 3,
     "error: {d}/missing.toml:2:1: garment.mesh: there is no file {d}/shrit.obj; paths are relative to the "
     "file that names them"},
    {"a garment's file in place of its table", "simulate {d}/named.toml", 3,
     "error: {d}/named.toml:1:1: garment = \"skirt.obj\" must be a table of settings; write garment.mesh = "
     "\"skirt.obj\""},
    {"a share without its sign", "chart {d}/missing.toml --accuracy 1", 2,
     "error: --accuracy takes a share of the garment's size such as 1%, not '1'"},
    {"a band without a length", "drape {m}/skirt.obj --body {m}/mannequin.obj --band top -o {d}/o.ply", 2,
     "error: --band top: there is no length; write a border loop and the band's length as a share of the "
     "loop's: --band top=0.95 is a band 5 % shorter than the garment's upper border"},
    {"a view without a picture", "drape {m}/skirt.obj --body {m}/mannequin.obj --view front -o {d}/o.ply", 2,
     "error: a view, --no-legend and --save-camera are of use with --picture only"},
    {"a legend left out of no picture", "fit {m}/skirt.obj --body {m}/mannequin.obj --no-legend", 2,
     "error: a view, --captions, --no-legend and --save-camera are of use with --picture only"},
    {"garments to compare without saying so", "fit {d}/sheet.obj {m}/skirt.obj --body {m}/mannequin.obj", 2,
     "error: 2 garments: say --compare to lay them side by side"},
    {"a section that there is not", "fit {m}/skirt.obj --body {m}/mannequin.obj --section knee=0.5", 2,
     "error: --section knee=0.5: 'knee' is none of chest, waist and hip; write a section and its height [m]: "
     "--section chest=1.25"},
    {"a texture on a mesh without coordinates", "render {m}/sheet.obj --texture checker -o {d}/p.png", 3,
     "error: {m}/sheet.obj: has no texture coordinates to lay --texture on with"},
    {"the target forgotten", "render {m}/sheet.obj --eye 0,0,3 -o {d}/p.png", 2,
     "error: --eye and --target go together"},
    {"two refinements at once", "subdivide {m}/sheet.obj --subdivide 1 --sqrt3 1 -o {d}/o.ply", 2,
     "error: subdivide takes one of --strokes, --all, --subdivide, --sqrt3 and --linear"},
    {"a refinement beyond memory", "subdivide {m}/sheet.obj --subdivide 6 -o {d}/o.ply", 2,
     "error: --subdivide 6: the mesh would have 2.4e+07 faces and take 14 GB; refine it less; --force goes "
     "on all the same"},
    {"another garment to transfer to", "transfer {m}/skirt.obj {m}/sheet.obj -o {d}/o.obj", 3,
     "error: {m}/sheet.obj: transfer: the wrinkled mesh does not say where its vertices lay before (vertex "
     "0); take the PLY that furrow wrinkle wrote, or name the shape before with --rest-shape"},
    {"a stroke changed that is not there",
     "strokes {m}/strokes/round_bulge.json --change rnig.height=0.01 -o {d}/l.json", 3,
     "error: there is no stroke 'rnig'; did you mean 'ring 1'?"},
    {"strokes changed and not written", "strokes {m}/strokes/round_bulge.json --remove 'ring 1'", 2,
     "error: changed strokes are written to -o"},
};

void write_files(const ScratchDirectory& d) {
  std::filesystem::copy_file(source_dir() / "meshes/sheet.obj", d / "sheet.obj");
  const auto strokes = [&](const char* name, const std::string& stroke) {
    write_text(d / name, "{\"strokes\": [" + stroke + "]}");
  };
  write_text(d / "empty.obj", "");
  write_text(d / "a.fbx", "Kaydara FBX Binary");
  write_text(d / "a.blend", "BLENDER-v304");
  write_text(d / "pointer.obj", "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n");
  write_text(d / "named.toml", "garment = \"skirt.obj\"\n");
  write_text(d / "bad.obj", "v 0 0 0\nv 1 0 zero\n");
  write_text(d / "mesh.blend", "BLENDER");
  write_text(d / "broken.json", "{\"strokes\": [");
  strokes("key.json", R"({"hieght": 0.01, "points": [[0,0.5,0],[0.2,0.5,0]]})");
  strokes("nopoints.json", R"({"height": 0.01})");
  strokes("none.json", "");
  strokes("cm.json", R"({"points": [[-20,50,0],[20,50,0]]})");
  strokes("far.json", R"({"name": "fold", "points": [[-0.2,0.5,0.3],[0.2,0.5,0.3]]})");
  strokes("width.json", R"({"width": -0.05, "points": [[-0.2,0.5,0],[0.2,0.5,0]]})");
  write_text(d / "mm.obj", "v 0 0 0\nv 500 0 0\nv 500 1700 0\nv 0 1700 300\nf 1 2 3\nf 1 3 4\n");
  write_text(d / "key.toml", "[garment]\nmesh = \"sheet.obj\"\n[material]\nstrech = 3\n");
  write_text(d / "missing.toml", "[garment]\nmesh = \"shrit.obj\"\n");
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace

TEST_CASE("mistakes: each ends with its exit code and a sentence that helps", "[long]") {
  const ScratchDirectory d;
  write_files(d);
  const std::string m = (source_dir() / "meshes").string();
  CHECK(std::size(mistakes) >= 46);
  for (const Mistake& mistake : mistakes) {
    INFO(mistake.what << ": furrow " << mistake.call);
    const Run run = run_furrow(replaced(replaced(mistake.call, "{m}", m), "{d}", d.path().string()));
    std::string told = replaced(replaced(run.err, m, "{m}"), d.path().string(), "{d}");
    told = replaced(
        told, io::mesh_formats(true, " and ") + " are read, " + io::mesh_formats(false, " and ") + " written",
        "{formats}");
    told = replaced(told, "choose " + io::mesh_formats(false, " or "), "choose {written}");
    CHECK(run.exit_code == mistake.exit_code);
    CHECK(told.substr(0, told.find('\n')) == mistake.first_line);
    CHECK(run.out.empty());
    for (const char* output : {"o.ply", "o.obj", "p.png", "l.json"})
      CHECK_FALSE(std::filesystem::exists(d / output));
    // No file is named twice in a row.
    CHECK_FALSE(std::regex_search(told, std::regex("([^ ]+): \\1:")));
  }
}

TEST_CASE("mistakes: a GLB that is both garment and body is refused before anything is searched") {
  const ScratchDirectory scratch;
  const std::string glb = scratch / "a.glb",
                    drape = "drape " + glb + " -o " + (scratch / "o.ply") + " --body ";
  REQUIRE(run_furrow("smooth " + source_file("meshes/sheet.obj") + " --iterations 0 -o " + glb).exit_code ==
          0);
  for (const char* figure : {"", "#cloth"}) {
    const Run run = run_furrow(drape + glb + figure);
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("name one figure of a GLB for each") != std::string::npos);
  }
}
