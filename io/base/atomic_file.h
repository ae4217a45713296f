// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>

namespace furrow::io {

/// Lets `write` fill a temporary beside `path` (".NAME.PID-N.tmp"), then renames it: a reader sees the old
/// file or the whole new one. A link is followed, and an old file's permissions are kept. What is not a
/// regular file (a pipe, /dev/null) is written directly. Throws std::runtime_error if the file cannot be
/// written, and what `write` throws; then the temporary is removed and the old file is as it was.
void write_atomically(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

}  // namespace furrow::io
