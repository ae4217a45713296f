// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/share_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "io/base/atomic_file.h"
#include "io/base/outputs_below.h"

namespace furrow::io {
namespace {

/// Ends with the process, at the latest.
class MakerLock {
 public:
  MakerLock(const std::filesystem::path& file, const std::function<void()>& wait)
      : handle_(::open((file.string() + ".lock").c_str(),
                       O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0644)) {
    try {
      while (handle_ >= 0 && ::flock(handle_, LOCK_EX | LOCK_NB) != 0 &&
             (errno == EWOULDBLOCK || errno == EINTR)) {
        wait();
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    } catch (...) {
      ::close(handle_);
      throw;
    }
  }
  ~MakerLock() {
    if (handle_ >= 0) ::close(handle_);
  }
  MakerLock(const MakerLock&) = delete;
  MakerLock& operator=(const MakerLock&) = delete;

 private:
  int handle_;
};

/// Whether the file is there and could be used; else `why` says what was wrong with one that is there.
bool was_read(const std::filesystem::path& path, const std::function<void()>& read, std::string& why) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::symlink_status(path, ignored);
  if (!std::filesystem::exists(status)) return false;
  if (!std::filesystem::is_regular_file(status)) {
    why = "it is a link, or no regular file";
    return false;
  }
  try {
    read();
    return true;
  } catch (const std::exception& e) {
    why = e.what();
    return false;
  }
}

}  // namespace

ShareReport share_file(const std::filesystem::path& path, const ShareSteps& steps) {
  ShareReport report;
  std::string unseen;
  if (was_read(path, steps.read, unseen)) return report;
  try {
    OutputsBelow::check(path);
  } catch (const std::runtime_error& e) {
    steps.make();
    return {.made = true, .broken = unseen, .unwritten = e.what()};
  }
  std::error_code ignored;
  std::filesystem::create_directories(path.parent_path(), ignored);
  const MakerLock lock(path, steps.wait);
  if (was_read(path, steps.read, report.broken)) return report;
  steps.make();
  report.made = true;
  try {
    const OutputAlone alone;
    const OutputsBelow below(path.parent_path());
    steps.write();
  } catch (const std::exception& e) {
    report.unwritten = e.what();
  }
  return report;
}

}  // namespace furrow::io
