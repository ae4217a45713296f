// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/stiffness.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/rest/bending_springs.h"

namespace furrow::geometry {

double spring_stiffness(double rest_length, double mean_rest_length, double k_std, StiffnessLaw law) {
  if (!(rest_length > 0) || !std::isfinite(rest_length))
    refuse("spring_stiffness", "rest_length is " + std::to_string(rest_length));
  if (!(mean_rest_length > 0) || !std::isfinite(mean_rest_length))
    refuse("spring_stiffness", "mean_rest_length is " + std::to_string(mean_rest_length));
  if (!(k_std >= 0) || !std::isfinite(k_std)) refuse("spring_stiffness", "k_std is " + std::to_string(k_std));
  switch (law) {
    case StiffnessLaw::proportional:
      return rest_length / mean_rest_length * k_std;
    case StiffnessLaw::constant:
      return k_std;
    case StiffnessLaw::inverse:
      return mean_rest_length / rest_length * k_std;
  }
  refuse("spring_stiffness", "there is no such law");
}

double mean_rest_length(const Mesh& mesh) {
  if (mesh.number_of_edges() == 0) throw ContentError("mean_rest_length: the mesh has no edges");
  double sum = 0;
  for (double length : rest_lengths(mesh)) sum += length;  // removed edges add 0
  return sum / static_cast<double>(mesh.number_of_edges());
}

double mean_bending_rest_length(const Mesh& mesh) {
  double sum = 0;
  const auto springs = bending_springs(mesh);
  for (const BendingSpring& s : springs) sum += s.rest_length;
  return springs.empty() ? 0 : sum / static_cast<double>(springs.size());
}

}  // namespace furrow::geometry
