// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <iostream>
#include <new>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "geometry/mesh/errors.h"
#include "io/base/nearest_word.h"
#include "physics/base/progress.h"

namespace {

using namespace furrow;

bool has_subcommand(const CLI::App& app, const std::string& word) {
  const auto subs = app.get_subcommands({});
  return std::any_of(subs.begin(), subs.end(), [&](const CLI::App* sub) { return sub->get_name() == word; });
}

/// The message for a first word that is no subcommand, with the nearest one.
std::string unknown_subcommand(const CLI::App& app, const std::string& word) {
  std::string nearest;
  std::size_t least = 4;
  for (const CLI::App* sub : app.get_subcommands({}))
    if (const std::size_t d = io::edit_distance(word, sub->get_name()); d < least) {
      least = d;
      nearest = sub->get_name();
    }
  return "there is no subcommand '" + word + "'" +
         (nearest.empty() ? "; furrow --help lists them" : "; did you mean '" + nearest + "'?");
}

int fail(int code, const std::string& message) {
  std::cerr << "error: " << message << "\n";
  return code;
}

int run(int argc, char** argv) {
  CLI::App app{
      "Furrow: cloth that wrinkles where you draw.\n"
      "Lengths are metres, masses kilograms, times seconds, unless an option says otherwise.\n\n"
      "  furrow wrinkle shirt.obj lines.json -o wrinkled.ply\n"
      "  furrow simulate wrinkled.ply --body body.obj -o worn.ply\n"
      "  furrow render worn.ply --body body.obj -o worn.png"};
  app.name("furrow");
  app.set_version_flag("--version", cli::version_text());
  app.require_subcommand(1);
  int exit_code = cli::exit_ok;
  cli::add_info(app);
  cli::add_subdivide(app);
  cli::add_smooth(app);
  cli::add_wrinkle(app);
  cli::add_strokes(app);
  cli::add_simulate(app, exit_code);
  cli::add_keep(app, exit_code);
  cli::add_chart(app, exit_code);
  cli::add_sdf(app);
  cli::add_render(app);
  cli::add_drape(app, exit_code);
  cli::add_fit(app);
  cli::add_transfer(app);
  cli::add_bake(app, exit_code);
  if (argc > 1 && argv[1][0] != '-' && !has_subcommand(app, argv[1]))
    return fail(cli::exit_usage, unknown_subcommand(app, argv[1]));
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return fail(cli::exit_usage,
                std::string(e.what()) + "; furrow " + (argc > 1 ? argv[1] : "") + " --help tells more");
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const physics::Cancelled&) {
    return fail(cli::exit_interrupted, "interrupted before anything was written");
  } catch (const cli::UsageError& e) {
    return fail(cli::exit_usage, e.what());
  } catch (const std::invalid_argument& e) {
    return fail(cli::exit_usage, e.what());
  } catch (const geometry::ContentError& e) {
    return fail(cli::exit_unreadable, e.what());
  } catch (const std::bad_alloc&) {
    return fail(cli::exit_failed, "not enough memory; try a smaller mesh or a larger --tolerance");
  } catch (const std::exception& e) {
    return fail(cli::exit_failed, e.what());
  }
}
