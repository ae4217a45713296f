// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace furrow::studio {

/// A message of a job, in which fields and jobs (io/base/field_words.h) have the page's names; advice about
/// what the page does not have is left out.
std::string in_page(const std::string& message);

}  // namespace furrow::studio
