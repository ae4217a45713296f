// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "jobs/frame.h"
#include "jobs/listener.h"
#include "jobs/memory_files.h"

namespace furrow::jobs {

using Json = nlohmann::ordered_json;

/// What every step of a job is given: the frame of its files, who listens, and what is in memory.
struct Context {
  Frame frame;
  Listener& listener;
  const MemoryFiles* memory = nullptr;  ///< null: all is in files

  void warn(std::string code, std::string text, std::string where = "", std::string help = "") const {
    listener.warn({std::move(code), std::move(text), std::move(where), std::move(help)});
  }
};

/// Throws physics::Cancelled if the listener cancels.
void stop_if_cancelled(const Context& context);

/// "3.6 mm".
std::string millimetres(double metres);

}  // namespace furrow::jobs
