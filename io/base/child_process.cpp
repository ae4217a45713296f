// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "geometry/mesh/errors.h"

namespace furrow::io {
namespace {

#ifdef FURROW_SANITIZED
constexpr bool limit_memory = false;
#else
constexpr bool limit_memory = true;
#endif

constexpr char answer_mark = 'A', error_mark = 'E';  // first byte of what the child sends

std::size_t own_address_space() {
  std::ifstream statm("/proc/self/statm");
  std::size_t pages = 0;
  statm >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void limit(__rlimit_resource resource, rlim_t value) {
  rlimit old{};
  ::getrlimit(resource, &old);
  if (old.rlim_max != RLIM_INFINITY && old.rlim_max < value) value = old.rlim_max;
  const rlimit wanted{value, value};
  ::setrlimit(resource, &wanted);
}

void send(int pipe, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t sent = ::write(pipe, bytes, size);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) ::_exit(1);
    bytes += sent;
    size -= static_cast<std::size_t>(sent);
  }
}

[[noreturn]] void be_child(int pipe, const std::function<std::string()>& work, const ChildLimits& limits,
                           std::size_t address_space) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGABRT, SIGXCPU})
    ::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.cpu_seconds);
  if (limit_memory) limit(RLIMIT_AS, address_space + limits.memory_bytes);
  char tag = answer_mark;
  std::string answer;
  try {
    answer = work();
  } catch (const std::bad_alloc&) {
    tag = error_mark, answer = "it needs too much memory";
  } catch (const std::exception& error) {
    tag = error_mark, answer = error.what();
  } catch (...) {
    tag = error_mark, answer = "unknown error";
  }
  send(pipe, &tag, 1);
  send(pipe, answer.data(), answer.size());
  ::_exit(0);
}

/// What the child sends until it closes the pipe. `why` is set if that takes too long or is too much.
std::string receive(int pipe, const ChildLimits& limits, std::string& why) {
  std::string bytes;
  std::array<char, 1 << 16> chunk;
  for (;;) {
    pollfd watched{pipe, POLLIN, 0};
    const int ready = ::poll(&watched, 1, static_cast<int>(limits.seconds) * 1000);
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) {
      why = "reading took more than " + std::to_string(limits.seconds) + " s";
      return {};
    }
    const ssize_t got = ::read(pipe, chunk.data(), chunk.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return bytes;
    bytes.append(chunk.data(), static_cast<std::size_t>(got));
    if (bytes.size() > limits.answer_bytes) {
      why = "the content is larger than " + std::to_string(limits.answer_bytes >> 20) + " MiB";
      return {};
    }
  }
}

std::string reason_of_death(int status, const ChildLimits& limits) {
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
    return "reading took more than " + std::to_string(limits.cpu_seconds) +
           " s of CPU time or too much memory";
  if (WIFSIGNALED(status)) return "the reader crashed (signal " + std::to_string(WTERMSIG(status)) + ")";
  return "the reader ended early (status " + std::to_string(WEXITSTATUS(status)) + ")";
}

}  // namespace

std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits) {
  if (!limits.memory_bytes || !limits.cpu_seconds || !limits.seconds || !limits.answer_bytes)
    throw std::invalid_argument("run_in_child: a limit is 0; all must be > 0");
  const std::size_t address_space = own_address_space();
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw std::runtime_error(std::string("no pipe: ") + std::strerror(errno));
  const pid_t child = ::fork();
  if (child < 0) {
    ::close(ends[0]), ::close(ends[1]);
    throw std::runtime_error(std::string("no child process: ") + std::strerror(errno));
  }
  if (child == 0) be_child(ends[1], work, limits, address_space);
  ::close(ends[1]);
  std::string why;
  std::string bytes = receive(ends[0], limits, why);
  ::close(ends[0]);
  if (!why.empty()) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (why.empty() && (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || bytes.empty()))
    why = reason_of_death(status, limits);
  if (why.empty() && bytes[0] == error_mark) why = bytes.substr(1);
  if (!why.empty()) throw geometry::ContentError(why);
  bytes.erase(0, 1);
  return bytes;
}

}  // namespace furrow::io
