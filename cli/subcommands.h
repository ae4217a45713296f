// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <string>

/// One function a subcommand, each in a file of its name: it parses, calls the library, writes.
namespace furrow::cli {

void add_info(CLI::App& app);
/// Sets exit_code where something is wrong, or is left after repair.
void add_doctor(CLI::App& app, int& exit_code);
/// Sets exit_code where a target is missed, with --check.
void add_quality(CLI::App& app, int& exit_code);
void add_subdivide(CLI::App& app);
void add_smooth(CLI::App& app);
/// Sets exit_code where what is drawn does not come to rest.
void add_wrinkle(CLI::App& app, int& exit_code);
void add_strokes(CLI::App& app);
/// Sets exit_code where the run was interrupted or diverged.
void add_simulate(CLI::App& app, int& exit_code);
/// Sets exit_code where nothing meets the tolerance, or the judgement was broken off.
void add_chart(CLI::App& app, int& exit_code);
/// Sets exit_code where a line cannot hold, or the work was interrupted.
void add_keep(CLI::App& app, int& exit_code);
void add_sdf(CLI::App& app);
void add_render(CLI::App& app);
void add_drape(CLI::App& app, int& exit_code);
/// Sets exit_code where no start of a disc comes to rest.
void add_fabric(CLI::App& app, int& exit_code);
void add_fit(CLI::App& app);
/// Sets exit_code where the studio was not built.
void add_studio(CLI::App& app, int& exit_code);
void add_transfer(CLI::App& app);
/// Sets exit_code where the run was interrupted.
void add_bake(CLI::App& app, int& exit_code);
/// Sets exit_code where a measurement is missed.
void add_body(CLI::App& app, int& exit_code);
/// Sets exit_code where a case failed or is open.
void add_batch(CLI::App& app, int& exit_code);

/// These two tell of all others, so they are added last.
void add_completion(CLI::App& app);
void add_man(CLI::App& app);

/// The program's version and those of the libraries that it was built with.
std::string version_text();

}  // namespace furrow::cli
