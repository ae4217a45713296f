// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/body/body_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <stdexcept>

#include "furrow/version.h"
#include "io/base/bytes_file.h"
#include "io/base/figure_path.h"
#include "io/base/share_file.h"
#include "jobs/base/kept_value.h"
#include "jobs/base/read_inputs.h"

namespace furrow::jobs {

/// What reading a body came to.
struct KnownBody {
  physics::TriangleMesh triangles;
  BodyOutline outline;
  std::vector<Warning> warnings;
};

template <class Archive>
void visit(Archive& a, Warning& w) {
  visit(a, w.code), visit(a, w.text), visit(a, w.where), visit(a, w.help);
}

template <class Archive>
void visit(Archive& a, KnownBody& b) {
  visit(a, b.triangles.vertices), visit(a, b.triangles.triangles);
  visit(a, b.outline.box.min()), visit(a, b.outline.box.max());
  visit(a, b.outline.closed), visit(a, b.outline.nearly_closed), visit(a, b.outline.figure);
  visit(a, b.warnings);
}

template <class Archive>
void visit(Archive& a, geometry::TrunkOutline& o) {
  visit(a, o.height), visit(a, o.centre), visit(a, o.radius);
}

template <class Archive>
void visit(Archive& a, geometry::ArmRing& r) {
  visit(a, r.along), visit(a, r.centre), visit(a, r.radius);
}

template <class Archive>
void visit(Archive& a, geometry::Arm& arm) {
  visit(a, arm.axis), visit(a, arm.length), visit(a, arm.rings);
}

template <class Archive>
void visit(Archive& a, geometry::Leg& leg) {
  visit(a, leg.slices), visit(a, leg.axis);
}

template <class Archive>
void visit(Archive& a, geometry::Skeleton& s) {
  for (double* height : {&s.low, &s.crotch, &s.waist, &s.armpits, &s.shoulders, &s.neck, &s.high})
    visit(a, *height);
  visit(a, s.trunk), visit(a, s.shoulder_half), visit(a, s.neck_slice), visit(a, s.arms), visit(a, s.legs);
  visit(a, s.faces);
}

namespace {

constexpr int layout = 2;  // of the files; another one when what they hold is made in another way

std::string hash_of(std::span<const std::byte> bytes) { return io::content_hash(bytes); }
std::string hash_of(const std::string& text) { return hash_of(std::as_bytes(std::span(text))); }

std::string hash_of(const physics::TriangleMesh& body) {
  return hash_of(std::as_bytes(std::span(body.vertices))) + hash_of(std::as_bytes(std::span(body.triangles)));
}

/// A file of the folder and all that its content depends on.
struct Place {
  std::filesystem::path path;
  std::string key;
};

Place place_of(const std::filesystem::path& folder, const std::string& kind, const std::string& depends_on) {
  const std::string key = fmt::format("furrow {} {} {}\n{}", FURROW_VERSION, kind, layout, depends_on);
  return {folder / (hash_of(key) + "." + kind), key};
}

void tell(const io::ShareReport& report, const std::filesystem::path& path, const Context& context) {
  if (!report.broken.empty())
    context.warn("cache_broken", path.string() + ": cannot be used, and was made again: " + report.broken,
                 path.string(), "body.cache");
  if (!report.unwritten.empty())
    context.warn("cache_unwritten", path.string() + ": what was made is not kept: " + report.unwritten,
                 path.string(), "body.cache");
}

/// The key, the block and a hash of both.
void write_block(const Place& place, const std::vector<std::byte>& block) {
  Saver saver;
  std::string key = place.key;
  visit(saver, key);
  std::vector<std::byte> bytes = saver.take();
  bytes.insert(bytes.end(), block.begin(), block.end());
  const std::string hash = hash_of(bytes);
  const auto end = std::as_bytes(std::span(hash));
  bytes.insert(bytes.end(), end.begin(), end.end());
  io::write_bytes(place.path, bytes);
}

std::vector<std::byte> read_block(const Place& place) {
  const std::vector<std::byte> bytes = io::read_bytes(place.path);
  constexpr std::size_t hash_length = 16;
  const std::span<const std::byte> all(bytes);
  const auto is_sound = [&] {
    const std::string hash = hash_of(all.first(all.size() - hash_length));
    return std::ranges::equal(all.last(hash_length), std::as_bytes(std::span(hash)));
  };
  if (all.size() < hash_length || !is_sound()) throw std::invalid_argument("it is cut or damaged");
  Loader loader(all.first(all.size() - hash_length));
  std::string key;
  visit(loader, key);
  if (key != place.key) throw std::invalid_argument("it is that of something else");
  return {bytes.end() - std::ptrdiff_t(hash_length + loader.left()),
          bytes.end() - std::ptrdiff_t(hash_length)};
}

template <class Value>
void write_value(const Place& place, Value& value) {
  Saver saver;
  visit(saver, value);
  write_block(place, saver.take());
}

template <class Value>
void read_value(const Place& place, Value& value) {
  const std::vector<std::byte> block = read_block(place);
  Loader loader(block);
  Value read;
  visit(loader, read);
  value = std::move(read);
}

/// Hears what a listener is told.
class Hearer : public Listener {
 public:
  explicit Hearer(Listener& other) : other_(other) {}
  void progress(const std::string& what, double share) override { other_.progress(what, share); }
  void warn(const Warning& warning) override {
    warnings.push_back(warning);
    other_.warn(warning);
  }
  bool cancelled() override { return other_.cancelled(); }
  bool allows(const std::string& demand) override {
    asked = true;
    return other_.allows(demand);
  }
  bool replaces(const std::string& path) override { return other_.replaces(path); }

  std::vector<Warning> warnings;
  bool asked = false;  ///< for leave: another listener may answer otherwise

 private:
  Listener& other_;
};

/// The file that is read; none: it is in memory, or what it names lies in files beside it.
std::optional<std::filesystem::path> file_of(const MeshInput& input, const Context& context) {
  const auto* path = std::get_if<std::filesystem::path>(&input);
  if (!path || (context.memory && context.memory->find_mesh(*path)) || io::ending_of(*path) == ".gltf")
    return std::nullopt;
  return *path;
}

/// Messages name the file: so its path counts.
std::string reading_of(const std::filesystem::path& path, const Frame& frame) {
  return fmt::format("{} {}\nunit {} up {} noted {} {}", path.string(), io::content_hash(path),
                     frame.unit.value_or("-"), frame.up.value_or("-"), frame.noted_unit, frame.noted_up);
}

std::string words_of(const physics::DistanceFieldOptions& o) {
  return fmt::format("{} {} {} {} {} {} {} {}", o.tolerance.value_or(0), o.outer_band, o.inner_band,
                     o.far_slope, o.margin, o.band_depth, o.max_depth, int(o.gradient));
}

}  // namespace

physics::TriangleMesh kept_body(const std::filesystem::path& folder, const MeshInput& input,
                                const Context& context, BodyOutline* outline) {
  const auto file = file_of(input, context);
  std::error_code ignored;
  if (folder.empty() || !file || !std::filesystem::is_regular_file(io::file_of_figure(*file), ignored))
    return read_body(input, context, outline);
  const Place place = place_of(folder, "body", reading_of(*file, context.frame));
  KnownBody known;
  Hearer hearer(context.listener);
  const io::ShareReport report = io::share_file(
      place.path,
      {.read = [&] { read_value(place, known); },
       .make =
           [&] {
             known.triangles = read_body(input, {context.frame, hearer, context.memory}, &known.outline);
           },
       .write =
           [&] {
             known.warnings = hearer.warnings;
             if (!hearer.asked) write_value(place, known);
           },
       .wait = [&] { stop_if_cancelled(context); }});
  if (!report.made)
    for (const Warning& warning : known.warnings) context.listener.warn(warning);
  tell(report, place.path, context);
  if (outline) *outline = known.outline;
  return std::move(known.triangles);
}

physics::DistanceField kept_field(const std::filesystem::path& folder, const physics::TriangleMesh& body,
                                  const physics::DistanceFieldOptions& options, const Context& context,
                                  const std::function<physics::DistanceField()>& make) {
  if (folder.empty()) return make();
  const Place place = place_of(folder, "field", hash_of(body) + "\n" + words_of(options));
  std::optional<physics::DistanceField> field;
  const io::ShareReport report = io::share_file(
      place.path, {.read = [&] { field = physics::DistanceField::from_bytes(read_block(place)); },
                   .make = [&] { field = make(); },
                   .write = [&] { write_block(place, field->to_bytes()); },
                   .wait = [&] { stop_if_cancelled(context); }});
  tell(report, place.path, context);
  return std::move(*field);
}

geometry::Skeleton kept_skeleton(const std::filesystem::path& folder, const physics::TriangleMesh& body,
                                 const Context& context, const std::function<geometry::Skeleton()>& make) {
  if (folder.empty()) return make();
  const Place place = place_of(folder, "skeleton", hash_of(body));
  geometry::Skeleton skeleton;
  const io::ShareReport report = io::share_file(place.path, {.read = [&] { read_value(place, skeleton); },
                                                             .make = [&] { skeleton = make(); },
                                                             .write = [&] { write_value(place, skeleton); },
                                                             .wait = [&] { stop_if_cancelled(context); }});
  tell(report, place.path, context);
  return skeleton;
}

}  // namespace furrow::jobs
