// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/output_checks.h"

#include <filesystem>

#include "io/base/figure_path.h"
#include "io/mesh/mesh_formats.h"
#include "jobs/base/own_output.h"

namespace furrow::jobs {

namespace fs = std::filesystem;

bool same_file(const std::string& one, const std::string& other) {
  const fs::path a = io::file_of_figure(one), b = io::file_of_figure(other);
  std::error_code none;
  if (a == b || fs::equivalent(a, b, none)) return true;
  const fs::path x = fs::weakly_canonical(a, none), y = fs::weakly_canonical(b, none);
  return !x.empty() && x == y;
}

void check_folder(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty() && !fs::is_directory(folder))
    throw std::runtime_error(path + ": cannot be written, there is no folder " + folder.string() +
                             "; make it first");
}

void check_output(const std::string& path) {
  if (path == "-") return;
  const io::MeshEnding* ending = io::find_mesh_ending(path);
  if (!ending)
    throw std::invalid_argument(path + ": the ending names no format that can be written; choose " +
                                io::mesh_formats());
  if (!ending->write) throw std::invalid_argument(path + ": " + ending->instead);
  check_folder(path);
}

void check_picture(const std::string& path, const std::string& option) {
  if (path.empty()) return;
  if (path == "-") throw std::invalid_argument(option + ": a picture needs a file name");
  if (io::ending_of(path) != ".png")
    throw std::invalid_argument(option + ": " + path +
                                ": pictures are written as PNG; let the name end in .png");
  check_folder(path);
}

void refuse_same(const std::string& output, const std::string& other) {
  if (!output.empty() && !other.empty() && same_file(output, other))
    throw std::invalid_argument(output + ": would replace " + other + "; choose another name");
}

void refuse_same(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (const std::string& input : inputs)
      if (input != "-") refuse_same(outputs[i], input);
    for (std::size_t k = 0; k < i; ++k) refuse_same(outputs[i], outputs[k]);
  }
}

void check_replaced(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs,
                    Listener& listener) {
  refuse_same(outputs, inputs);
  std::error_code none;
  for (const std::string& output : outputs)
    if (!output.empty() && output != "-" && fs::is_regular_file(output, none) && !is_own_output(output) &&
        !listener.replaces(output))
      throw std::invalid_argument(
          output + ": exists, and furrow did not write it; name another file, or add " + "`replace`");
}

}  // namespace furrow::jobs
