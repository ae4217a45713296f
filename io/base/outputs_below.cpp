// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/outputs_below.h"

#include <stdexcept>
#include <utility>

namespace furrow::io {

namespace fs = std::filesystem;

thread_local const OutputsBelow* OutputsBelow::present_ = nullptr;

OutputsBelow::OutputsBelow(const fs::path& folder)
    : folder_(fs::absolute(folder.empty() ? "." : folder).lexically_normal()),
      around_(std::exchange(present_, this)) {}

OutputsBelow::~OutputsBelow() { present_ = around_; }

void OutputsBelow::check(const fs::path& path) {
  if (present_) present_->check_below(path);
}

void OutputsBelow::check_below(const fs::path& path) const {
  const auto bar = [&](const std::string& why) {
    throw std::runtime_error(path.string() + ": is not written: " + why);
  };
  const fs::path way = fs::absolute(path).lexically_normal().lexically_relative(folder_);
  if (way.empty() || way == "." || *way.begin() == "..") bar("it lies outside of " + folder_.string());
  fs::path at = folder_;
  for (auto part = way.begin(); part != way.end(); ++part) {
    at /= *part;
    std::error_code none;
    const fs::file_status status = fs::symlink_status(at, none);
    if (!fs::exists(status)) return;  // nor does what lies in it
    if (fs::is_symlink(status)) bar(at.string() + " is a link, and may lead anywhere; remove it");
    if (!fs::is_directory(status) && !fs::is_regular_file(status))
      bar(at.string() + " is no regular file; remove it");
  }
}

}  // namespace furrow::io
