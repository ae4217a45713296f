// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "jobs/base/inputs.h"

namespace furrow::studio {

using Client = std::uint64_t;  ///< a page that is connected
inline constexpr Client everybody = 0;
using Bytes = std::shared_ptr<const std::string>;

/// Where answers and meshes go. Called in the worker's thread; a page that is gone hears nothing.
class Outbox {
 public:
  virtual ~Outbox() = default;
  virtual void tell(Client client, const jobs::Json& message) = 0;
  /// A mesh: a page that is slow gets the latest one only.
  virtual void show(Client client, Bytes frame) = 0;
};

}  // namespace furrow::studio
