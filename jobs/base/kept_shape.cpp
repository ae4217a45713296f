// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/base/kept_shape.h"

#include <nlohmann/json.hpp>

namespace furrow::jobs {

Json to_json(const physics::PrestressReport& rest, const physics::Certificate& certificate) {
  Json imbalance = Json::array();
  for (const physics::RigidImbalance& i : rest.imbalance)
    imbalance.push_back({{"vertices", i.piece.size()},
                         {"freedoms", i.freedoms},
                         {"axis", {i.axis.x(), i.axis.y(), i.axis.z()}},
                         {"point", {i.point.x(), i.point.y(), i.point.z()}},
                         {"acceleration", i.largest}});
  Json json{{"residual", certificate.residual},
            {"stable", certificate.stable()},
            {"negative_eigenvalues", certificate.negative_eigenvalues},
            {"frequency", certificate.frequency},
            {"max_strain", rest.max_strain},
            {"max_angle", rest.max_angle},
            {"bounds_active", rest.active_bounds()},
            {"touching", rest.touching.size()}};
  if (!imbalance.empty()) json["imbalance"] = imbalance;
  return json;
}

Json to_json(const bridge::KeptShape& kept) {
  Json json = to_json(kept.rest, kept.certificate);
  if (kept.turned > 0) json["turned"] = kept.turned;
  if (kept.pushed.moved > 0)
    json["pushed_out"] = {{"vertices", kept.pushed.moved}, {"farthest", kept.pushed.farthest}};
  return json;
}

}  // namespace furrow::jobs
