// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

namespace furrow::jobs {

/// By which the page of a batch is known again.
inline constexpr const char* batch_page_mark = "<meta name=generator content=furrow>";

/// Whether a file looks as what furrow writes, of this version or an earlier one: then it may be replaced
/// without asking. By content alone, whatever the name (but MDD, which has no mark: by its ending and its
/// length); an empty file counts, as nothing is lost with it. Reads at most 16 MB of meshes, the heads of
/// PNG's chunks, and JSON whole. A file that cannot be read is not furrow's. docs/reports.md says what is
/// looked at in each format, and what of other programs cannot be told from it.
bool is_own_output(const std::filesystem::path& path);

}  // namespace furrow::jobs
