// SPDX-License-Identifier: GPL-3.0-or-later
#include "furrow/version.h"

#include <CGAL/version.h>
#include <assimp/version.h>
#include <embree3/rtcore_config.h>
#include <png.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "cli/subcommands.h"

namespace furrow::cli {

std::string version_text() {
  const auto dotted = [](auto major, auto minor, auto patch) {
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
  };
  return std::string("furrow " FURROW_VERSION "\nCGAL ") + CGAL_VERSION_STR + "\nEigen " +
         dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION) + "\nEmbree " +
         RTC_VERSION_STRING + "\nassimp " +
         dotted(aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch()) + "\nlibpng " +
         PNG_LIBPNG_VER_STRING + "\nCLI11 " CLI11_VERSION "\nnlohmann-json " +
         dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH);
}

}  // namespace furrow::cli
