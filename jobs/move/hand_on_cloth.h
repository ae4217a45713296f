// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>

#include "jobs/move/simulate.h"
#include "physics/cloth/cloth.h"

namespace furrow::jobs {

/// A hand that pulls at a cloth while it moves: it takes the cloth within 3 cm of the vertex, as it lies when
/// it takes hold, and draws each particle there to its own place beside the hand's by a spring. At 5 cm off
/// all of them together pull with the cloth's weight under g = 9.81 m/s^2.
class HandOnCloth {
 public:
  HandOnCloth(const Hand& hand, physics::Cloth& cloth);
  ~HandOnCloth();
  HandOnCloth(const HandOnCloth&) = delete;
  HandOnCloth& operator=(const HandOnCloth&) = delete;

  /// Asks where the hand is; what it holds follows. true: it has taken hold, or let go, and the cloth has
  /// another energy from renew() on, which must not happen within a call of simulate().
  bool asks_for_renewal(double time);
  /// Takes hold or lets go, as was asked for; whether the cloth has changed.
  bool renew();

 private:
  class Tether;
  const Hand& hand_;
  physics::Cloth& cloth_;
  std::optional<Grip> wanted_;
  std::shared_ptr<Tether> tether_;  ///< null: it holds nothing
};

}  // namespace furrow::jobs
