// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "tests/physics/rest/settled.h"

namespace furrow::bench {

/// One line of the table.
struct Row {
  const char* what;
  const char* mesh;
  double parameter;   ///< Gamma, number of springs or shortening
  int rows, columns;  ///< cells along and across
  double measured = 0, reference = 0;
  double error =
      0;  ///< relative to the reference; of chains and slopes absolute, of ladder tips by the length
  double target = 0;  ///< largest |error| asked for; 0: none
  tests::Settled report = {};
  double seconds = 0;
};

void print_header();
void print(const Row& row);

/// Finds the rest and notes in the row what it took.
void rest(physics::Cloth& cloth, const physics::SettleOptions& options, Row& row);

void buckling();
void postbuckled();

}  // namespace furrow::bench
