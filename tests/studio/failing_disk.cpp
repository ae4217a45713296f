// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/studio/failing_disk.h"

#include <dlfcn.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <tuple>

namespace furrow::tests {

thread_local FailingDisk* FailingDisk::present_ = nullptr;

FailingDisk::FailingDisk(double share, std::uint64_t seed) : share_(share), random_(seed) { present_ = this; }
FailingDisk::~FailingDisk() { present_ = nullptr; }

bool FailingDisk::fails() {
  if (!present_ || double(present_->random_() >> 11) * 0x1p-53 >= present_->share_) return false;
  ++present_->failed_;
  return true;
}

namespace {

/// The system's own function of that name.
template <class Function>
Function* systems(const char* name, Function*) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

int refuse(int why) {
  errno = why;
  return -1;
}

}  // namespace
}  // namespace furrow::tests

using furrow::tests::FailingDisk;
using furrow::tests::refuse;
using furrow::tests::systems;

extern "C" {

ssize_t write(int file, const void* bytes, size_t count) {
  static auto* const real = systems("write", &write);
  if (!FailingDisk::fails()) return real(file, bytes, count);
  if (count > 1) std::ignore = real(file, bytes, count / 2);
  return refuse(ENOSPC);
}

ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
  static auto* const real = systems("pwrite", &pwrite);
  if (!FailingDisk::fails()) return real(file, bytes, count, at);
  if (count > 1) std::ignore = real(file, bytes, count / 2, at);
  return refuse(ENOSPC);
}

int fsync(int file) {
  static auto* const real = systems("fsync", &fsync);
  return FailingDisk::fails() ? refuse(EIO) : real(file);
}

int ftruncate(int file, off_t size) noexcept {
  static auto* const real = systems("ftruncate", &ftruncate);
  return FailingDisk::fails() ? refuse(EIO) : real(file, size);
}

int rename(const char* from, const char* to) noexcept {
  static auto* const real = systems("rename", &rename);
  return FailingDisk::fails() ? refuse(EIO) : real(from, to);
}

int remove(const char* path) noexcept {
  static auto* const real = systems("remove", &remove);
  return FailingDisk::fails() ? refuse(EIO) : real(path);
}

}  // extern "C"
