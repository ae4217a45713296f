// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/run_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/auxv.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

extern char** environ;

namespace furrow::io {
namespace {

using UnnamedFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

UnnamedFile unnamed_file() {
  UnnamedFile file(std::tmpfile(), std::fclose);
  if (!file) throw std::runtime_error(std::string("no temporary file can be made: ") + std::strerror(errno));
  return file;
}

std::string content_of(std::FILE* file) {
  std::string text;
  std::rewind(file);
  char part[65536];
  for (std::size_t n; (n = std::fread(part, 1, sizeof part, file)) > 0;) text.append(part, n);
  return text;
}

double seconds_of(const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); }

/// Waits although signals come.
int wait_for(pid_t child, rusage& used) {
  int status = 0;
  while (wait4(child, &status, 0, &used) < 0)
    if (errno != EINTR) throw std::runtime_error(std::string("wait4: ") + std::strerror(errno));
  return status;
}

}  // namespace

ProgramRun run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
  const UnnamedFile out = unnamed_file(), err = unnamed_file();
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(out.get()), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(err.get()), STDERR_FILENO);
  const auto begin = std::chrono::steady_clock::now();
  pid_t child = 0;
  const int failed = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed) throw std::runtime_error(program.string() + " cannot be run: " + std::strerror(failed));

  ProgramRun run;
  rusage used{};
  const int status = wait_for(child, used);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  run.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  run.processor_seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  run.peak_bytes = std::size_t(used.ru_maxrss) * 1024;
  run.out = content_of(out.get());
  run.err = content_of(err.get());
  return run;
}

std::filesystem::path this_program() {
  std::error_code failed;
  const std::filesystem::path link = std::filesystem::read_symlink("/proc/self/exe", failed);
  if (!failed) return link;
  // A chroot may have no /proc: the name by which it was started, of the folder in which it was.
  const auto* name = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  return name ? std::filesystem::weakly_canonical(name, failed) : std::filesystem::path();
}

}  // namespace furrow::io
