// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "io/base/outputs_below.h"

namespace furrow::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* mark = ".furrow-";
constexpr std::size_t longest_stem = 150;  // bytes of the target's name in the temporary's, which has 255

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw std::runtime_error(path.string() + ": cannot be written: " + why);
}

/// Whether the name is one that Temporary gives.
bool is_temporary(const std::string& name) {
  const std::size_t at = name.rfind(mark);
  if (name.empty() || name[0] != '.' || at == std::string::npos) return false;
  const std::string tail = name.substr(at + std::strlen(mark));
  return tail.size() > 7 && tail.ends_with(".tmp") &&
         tail.find_first_not_of("0123456789-") == tail.size() - 4;
}

/// Removes a temporary that nobody writes any more.
void remove_if_abandoned(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
  if (file < 0) return;
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
  ::close(file);
}

/// Once a process and folder: removes what killed runs left there.
void sweep(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<fs::path> swept;
  {
    const std::lock_guard lock(mutex);
    if (!swept.insert(folder).second) return;
  }
  std::error_code none;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, none), end; !none && at != end;
       at.increment(none))
    if (is_temporary(at->path().filename().string())) remove_if_abandoned(at->path());
}

/// The file that the path leads to, over links, be it there or not.
fs::path end_of_links(fs::path path) {
  const fs::path shown = path;
  std::error_code none;
  for (int links = 0; fs::is_symlink(path, none); ++links) {
    if (links == 40) fail(shown, "its links lead nowhere");
    path = path.parent_path() / fs::read_symlink(path, none);
  }
  return path;
}

void synchronise_folder(const fs::path& folder) {
  const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;  // it can be written, but not listed
  ::fsync(file);
  ::close(file);
}

/// An empty file beside the target that did not exist before; removed again unless renamed.
class Temporary {
 public:
  explicit Temporary(fs::path target) : target_(std::move(target)) {
    static std::atomic<unsigned> number{0};
    const std::string stem =
        "." + target_.filename().string().substr(0, longest_stem) + mark + std::to_string(::getpid()) + "-";
    sweep(target_.parent_path());
    while (file_ < 0) {
      path_ = target_.parent_path() / (stem + std::to_string(number++) + ".tmp");
      file_ = ::open(path_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
      if (file_ < 0 && errno != EEXIST) fail(target_, why_not_made());
      if (file_ >= 0 && !lock()) {
        ::close(file_);
        file_ = -1;
      }
    }
  }
  Temporary(Temporary&& other) noexcept
      : target_(std::move(other.target_)),
        path_(std::move(other.path_)),
        file_(std::exchange(other.file_, -1)) {}
  Temporary& operator=(Temporary&&) = delete;
  ~Temporary() {
    if (file_ < 0) return;
    ::unlink(path_.c_str());
    ::close(file_);
  }

  const fs::path& path() const { return path_; }
  const fs::path& target() const { return target_; }

  void synchronise() {
    if (::fsync(file_) != 0 && errno != EINVAL) fail(target_, std::strerror(errno));
  }
  void rename() {
    std::error_code error;
    fs::rename(path_, target_, error);
    if (error) fail(target_, error.message());
    ::close(std::exchange(file_, -1));
  }

 private:
  /// False if another process took the new file for an abandoned one and removed it.
  bool lock() const {
    struct stat here, there;
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
    return ::fstat(file_, &here) == 0 && ::stat(path_.c_str(), &there) == 0 && here.st_ino == there.st_ino;
  }
  std::string why_not_made() const {
    const int error = errno;
    if (error != EACCES && error != EPERM) return std::strerror(error);
    const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
    return std::string(std::strerror(error)) + "; a new file is made beside the old one, so the folder " +
           folder.string() + " must be writable";
  }

  fs::path target_, path_;
  int file_ = -1;  ///< locked; -1: renamed
};

void fill(const fs::path& path, const fs::path& shown, const std::function<void(std::ostream&)>& write) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  if (!out) fail(shown, std::strerror(errno));
  write(out);
  out.close();
  if (!out) fail(shown, errno ? std::strerror(errno) : "unknown reason");
}

}  // namespace

class OutputGroup::Pending {
 public:
  void add(Temporary&& temporary) {
    std::erase_if(all_,
                  [&](const std::unique_ptr<Temporary>& t) { return t->target() == temporary.target(); });
    all_.push_back(std::make_unique<Temporary>(std::move(temporary)));
  }
  void rename() {
    std::set<fs::path> folders;
    for (const auto& temporary : all_) {
      temporary->rename();
      folders.insert(temporary->target().parent_path());
    }
    all_.clear();
    for (const fs::path& folder : folders) synchronise_folder(folder);
  }

 private:
  std::vector<std::unique_ptr<Temporary>> all_;
};

thread_local OutputGroup* OutputGroup::outermost_ = nullptr;

OutputGroup::OutputGroup() {
  if (outermost_) return;
  pending_ = std::make_unique<Pending>();
  outermost_ = this;
}

OutputGroup::~OutputGroup() {
  if (outermost_ == this) outermost_ = nullptr;
}

void OutputGroup::commit() {
  if (pending_) pending_->rename();
}

OutputAlone::OutputAlone() : around_(std::exchange(OutputGroup::outermost_, nullptr)) {}

OutputAlone::~OutputAlone() { OutputGroup::outermost_ = around_; }

void write_atomically(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  OutputsBelow::check(path);
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  const bool exists = fs::exists(status);
  if (fs::is_directory(status)) fail(path, "it is a folder");
  if (exists && !fs::is_regular_file(status)) return fill(path, path, write);
  Temporary temporary(exists ? fs::canonical(path) : end_of_links(path));
  fill(temporary.path(), path, write);
  if (exists) fs::permissions(temporary.path(), status.permissions(), ignored);
  temporary.synchronise();
  OutputGroup alone;
  (alone.pending_ ? alone : *OutputGroup::outermost_).pending_->add(std::move(temporary));
  alone.commit();
}

}  // namespace furrow::io
