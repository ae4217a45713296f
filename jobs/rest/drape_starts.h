// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "jobs/rest/drape.h"

namespace furrow::jobs {

/// What one rest tells among several.
DrapeStart start_of(const Draped& draped, std::uint64_t seed);

/// Whether an end is taken in place of another: the judge of ends calls it better, or they are equal there
/// and its energy is lower by more than a millionth of the largest part of it.
bool is_better(const DrapeStart& a, const DrapeStart& b);

/// Mean and spread of each number over the starts that rest, in the order of the first that knows it; of the
/// energies, too ("energy").
std::vector<NumberSpread> spread_of(std::span<const DrapeStart> starts);

/// Where starts do not agree on what a number decides: their outcomes; ease by more than tells one size from
/// the next; the hem's height by more than a hem is marked to. Empty with one start.
std::vector<Warning> doubts_of(const Draped& draped);

Json to_json(const DrapeStarts& starts);
Json to_json(const bridge::EnergyParts& energy);

}  // namespace furrow::jobs
