// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <iosfwd>
#include <nlohmann/json.hpp>

#include "io/scene/batch_plan.h"

namespace furrow::jobs {

/// A page of a batch in one file of HTML, written row by row: a table that sorts by a click and is searched
/// by words, with the pictures in it (up to 64 MB of them; later ones are linked to). It asks nothing of the
/// network.
class BatchPage {
 public:
  BatchPage(const io::BatchPlan& plan, std::ostream& out);
  /// A row of results.jsonl.
  void add(const nlohmann::ordered_json& row);
  void end();

 private:
  void add_picture(const nlohmann::ordered_json& row);

  const io::BatchPlan& plan_;
  std::ostream& out_;
  std::size_t picture_bytes_ = 0;
};

}  // namespace furrow::jobs
