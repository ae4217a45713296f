// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "tests/physics/cloth/test_cloths.h"

namespace furrow::tests {

/// The same cloth with tension in place of structural springs [N].
inline Cloth with_tension(Cloth cloth, double stretch, double compress) {
  for (const Spring& s : cloth.structural)
    cloth.tension.push_back({s.a, s.b, s.rest_length, stretch, compress});
  cloth.structural.clear();
  return cloth;
}

}  // namespace furrow::tests
