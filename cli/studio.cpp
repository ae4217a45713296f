// SPDX-License-Identifier: GPL-3.0-or-later
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <memory>
#include <thread>

#include "cli/common.h"
#include "cli/scene_flags.h"
#include "cli/shipped.h"
#include "cli/subcommands.h"
#include "io/base/figure_path.h"
#include "jobs/base/read_inputs.h"
#ifdef FURROW_STUDIO
#include <sys/wait.h>
#include <unistd.h>

#include "studio/studio.h"
#endif

namespace furrow::cli {
namespace {

struct StudioArguments : CommonArguments {
  std::string in, project, made_for;
  unsigned short port = 0;
  bool no_browser = false, replay = false, headless = false;
  SceneFlags flags;
};

#ifdef FURROW_STUDIO
/// Shows an address or a folder to the user, if there is a program that does.
void show_place(const std::string& place) {
  const pid_t child = fork();
  if (child < 0) return;
  if (child == 0) {
    if (fork() == 0) {  // a grandchild, which nobody needs to wait for
      for (const char* opener : {"xdg-open", "open"})
        execlp(opener, opener, place.c_str(), static_cast<char*>(nullptr));
    }
    _exit(0);
  }
  waitpid(child, nullptr, 0);
}

/// The folder of a new drawing: beside nothing, in the working directory, named after what is drawn on.
std::filesystem::path project_of(const StudioArguments& a) {
  if (!a.project.empty()) return a.project;
  return io::stem_of(a.in) + "-studio";
}

/// One that says what is drawn on; "": none does.
std::string first_flag(const StudioArguments& a) {
  return a.made_for.empty() ? a.flags.first() : "--made-for";
}

std::unique_ptr<studio::Studio> open_studio(const StudioArguments& a) {
  const studio::Places places{shipped("scenes/studio"), ".",
                              [](const std::filesystem::path& folder) { show_place(folder.string()); }};
  if (a.in.empty()) {
    const std::string flag = !a.project.empty() ? "--project" : first_flag(a);
    if (!flag.empty()) throw UsageError(flag + ": belongs to a garment, which is not named");
    return std::make_unique<studio::Studio>(places, a.port);
  }
  if (std::filesystem::is_directory(a.in)) {
    if (!studio::Studio::is_project(a.in))
      throw UsageError(a.in + ": is a folder, but no project of the studio; name a garment or a scene");
    if (!first_flag(a).empty())
      throw UsageError(first_flag(a) + ": the project " + a.in + " has its own; leave it out");
    return std::make_unique<studio::Studio>(std::filesystem::path(a.in), a.port, places);
  }
  SceneInput scene;
  scene.settings = scene_settings(a.in, "", std::nullopt, a.flags, a);
  if (is_scene(a.in)) scene.folder = std::filesystem::path(a.in).parent_path();
  return std::make_unique<studio::Studio>(scene, project_of(a), a.port, places, a.made_for);
}

/// A new folder in a project, which goes again unless it is kept.
class FreshFolder {
 public:
  explicit FreshFolder(const std::string& project)
      : path_((std::filesystem::path(project) / "replay-XXXXXX").string()) {
    if (!mkdtemp(path_.data()))
      throw std::runtime_error(project + ": no folder can be made in it: " + std::strerror(errno));
  }
  ~FreshFolder() {
    std::error_code none;
    if (!keeps_) std::filesystem::remove_all(path_, none);
  }
  FreshFolder(const FreshFolder&) = delete;
  FreshFolder& operator=(const FreshFolder&) = delete;
  const std::string& path() const { return path_; }
  void keep() { keeps_ = true; }

 private:
  std::string path_;
  bool keeps_ = false;
};

/// Does all that a project's log says once more, and compares.
int replay(const StudioArguments& a) {
  if (!a.headless) throw UsageError("--replay: is done without a page; add --headless");
  if (!studio::Studio::is_project(a.in))
    throw UsageError(a.in + ": is no project of the studio; name the folder of one to --replay");
  FreshFolder into(a.in);
  Terminal terminal(a);
  const studio::ReplayReport report =
      studio::replay(std::filesystem::path(a.in), into.path(), [&](std::size_t done, std::size_t of) {
        terminal.progress("replaying", double(done) / double(of));
        return !interrupted();
      });
  terminal.progress("replaying", 1);
  const bool same = report.difference.empty() && !report.cancelled;
  if (!report.difference.empty()) into.keep();
  const std::string outcome = report.cancelled ? "interrupted" : same ? "same bits" : "differs";
  if (a.json) {
    Json json{{"outcome", outcome}, {"intentions", report.intentions}, {"steps", report.steps}};
    if (!report.difference.empty()) json["difference"] = report.difference;
    print_report(json, a);
  } else if (!a.quiet) {
    std::cout << a.in << ": " << outcome << " (" << report.intentions << " intentions, step " << report.steps
              << ")\n";
  }
  if (!report.difference.empty())
    std::cerr << "error: " << a.in << ": replayed, " << report.difference << "; what was made is in "
              << into.path() << "\n";
  return exit_code_of(report.cancelled, same);
}

int serve(const StudioArguments& a) {
  catch_interrupts();
  if (a.replay) return replay(a);
  if (a.headless)
    throw UsageError("--headless: belongs to --replay; --no-browser serves without opening one");
  const std::unique_ptr<studio::Studio> studio = open_studio(a);
  const std::string project = a.in.empty()                          ? std::string()
                              : std::filesystem::is_directory(a.in) ? std::string(a.in)
                                                                    : project_of(a).string();
  if (a.json) {
    print_report({{"url", studio->url()}, {"project", project.empty() ? Json() : Json(project)}}, a);
  } else {
    std::cout << "The studio is open: " << studio->url() << "\n";
    if (!a.quiet && project.empty())
      std::cout
          << "Choose a garment there, or drop yours on the page; drawings are kept in folders of this one.\n"
             "Ctrl-C ends it.\n";
    else if (!a.quiet)
      std::cout << "Every step is kept in " << project << "; go on later with: furrow studio " << project
                << "\nCtrl-C ends it.\n";
  }
  flush_output();
  if (!a.no_browser) show_place(studio->url());
  while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return exit_ok;  // that is how it is meant to end; nothing is lost
}
#else
int serve(const StudioArguments&) {
  std::cerr << "error: this furrow was built without the studio; install nodejs, npm and libboost-dev, and "
               "build it "
               "again (cmake -DFURROW_STUDIO=ON)\n";
  return exit_failed;
}
#endif

void add_studio(CLI::App& sub, StudioArguments& a) {
  sub.add_option(
      "garment", a.in,
      "garment to draw on, a scene (a .toml file), or the folder of a drawing to go on with; none: "
      "it is chosen in the page");
  sub.add_option("--project", a.project,
                 "folder in which every step is kept; made if it is not there (default: the garment's name "
                 "and -studio)");
  sub.add_option("--made-for", a.made_for,
                 "body that the garment was made for and lies about, in its unit: it is drawn on there, and "
                 "a drape brings it to --body in its own size");
  sub.add_option("--port", a.port, "of 127.0.0.1 to serve on (default: a free one)");
  sub.add_flag("--no-browser", a.no_browser, "print the address, and open no browser");
  sub.add_flag("--replay", a.replay,
               "do all that the log of a project says once more, and tell whether it ends in the same bits");
  sub.add_flag("--headless", a.headless, "with --replay: without a page");
  a.flags.add_to(sub, io::used_by::wrinkle);
}

const Subcommand studio_subcommand(200, "studio",
                                   "Draw on a garment with a pen, in the browser, and watch it wrinkle\n\n"
                                   "  furrow studio\n"
                                   "  furrow studio skirt.obj --body body.obj\n"
                                   "  furrow studio scene.toml --project tuesday\n"
                                   "  furrow studio skirt-studio\n"
                                   "  furrow studio --replay skirt-studio --headless",
                                   add_studio, serve);

}  // namespace
}  // namespace furrow::cli
