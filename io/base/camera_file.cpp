// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/camera_file.h"

#include <ostream>
#include <stdexcept>

#include "io/base/atomic_file.h"
#include "io/base/bytes_file.h"
#include "io/base/own_mark.h"
#include "io/base/text_scanner.h"

namespace furrow::io {
namespace {

using Json = JsonFields::Json;

Position position(const Json& object, const char* key, const JsonFields& fields) {
  const auto x = fields.numbers(object[key], key, 3, "three numbers [x, y, z]");
  return {x[0], x[1], x[2]};
}

}  // namespace

CameraPicture camera_from(const Json& object, const JsonFields& fields) {
  if (!object.is_object()) fields.fail("a camera must be an object {\"eye\": …, \"target\": …, \"size\": …}");
  fields.check_keys(object, {"eye", "target", "up", "fov", "parallel", "size", "generator"});
  for (const char* key : {"eye", "target", "size"})
    if (!object.contains(key)) fields.fail(std::string("'") + key + "' of the camera is missing");
  if (object.contains("fov") && object.contains("parallel"))
    fields.fail("a camera has 'fov' or 'parallel', not both");
  CameraPicture picture;
  picture.camera.eye = position(object, "eye", fields);
  picture.camera.target = position(object, "target", fields);
  if (object.contains("up")) picture.camera.up = position(object, "up", fields);
  if (object.contains("fov")) picture.camera.field_of_view_deg = fields.number(object["fov"], "fov");
  if (object.contains("parallel"))
    picture.camera.parallel_height = fields.number(object["parallel"], "parallel");
  const Json& size = object["size"];
  if (!size.is_array() || size.size() != 2) fields.fail("'size': two numbers [width, height] are needed");
  const std::size_t width = fields.index(size[0], "size"), height = fields.index(size[1], "size");
  picture.width = static_cast<int>(std::min<std::size_t>(width, 100000));
  picture.height = static_cast<int>(std::min<std::size_t>(height, 100000));
  try {
    check(picture);
  } catch (const std::invalid_argument& error) {
    fields.fail(error.what());
  }
  return picture;
}

CameraPicture read_camera(const std::filesystem::path& path) {
  const JsonFields fields(path.string());
  const std::string text = read_text(path);
  return camera_from(fields.parse(plain_text(text, path.string())), fields);
}

Json to_json(const CameraPicture& picture) {
  check(picture);
  const Camera& c = picture.camera;
  Json object{{"eye", c.eye}, {"target", c.target}, {"up", c.up}};
  if (c.parallel_height)
    object["parallel"] = *c.parallel_height;
  else
    object["fov"] = c.field_of_view_deg;
  object["size"] = {picture.width, picture.height};
  return object;
}

void write_camera(const std::filesystem::path& path, const CameraPicture& picture) {
  Json object = to_json(picture);
  object["generator"] = own_generator;
  write_atomically(path, [&](std::ostream& out) { out << object.dump() << '\n'; });
}

}  // namespace furrow::io
