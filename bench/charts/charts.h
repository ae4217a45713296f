// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace furrow::bench {

enum class Effort { quick, full };

/// Each writes CSV files into the folder.
void chart_machine(const std::string& folder, Effort effort);  ///< machine.csv: what it was measured on
void chart_laws(const std::string& folder, Effort effort);     ///< laws.csv
void chart_bending(const std::string& folder, Effort effort);  ///< bending.csv
void chart_work_precision(const std::string& folder,
                          Effort effort);                          ///< work*.csv: points, references, fronts
void chart_implicit(const std::string& folder, Effort effort);     ///< implicit.csv, energy.csv, rests.csv
void chart_stability(const std::string& folder, Effort effort);    ///< stability.csv
void chart_damping(const std::string& folder, Effort effort);      ///< damping.csv
void chart_contact(const std::string& folder, Effort effort);      ///< contact.csv
void chart_equilibria(const std::string& folder, Effort effort);   ///< equilibria.csv
void chart_metamorphic(const std::string& folder, Effort effort);  ///< metamorphic.csv

}  // namespace furrow::bench
