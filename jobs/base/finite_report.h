// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// A report as programs are given it: with the version of its schema first. Numbers that JSON has no word for
/// become null; `not_finite` says where they stood and what they were.
Json finite_report(const Json& report);

/// null where there is none.
inline Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

}  // namespace furrow::jobs
