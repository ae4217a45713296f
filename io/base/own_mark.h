// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>

namespace furrow::io {

/// What our files say of themselves, each as its format allows it, so that they are known again: in a comment
/// (PLY, OBJ, OFF), a head (STL), a chunk (PNG), behind the last frame (PC2, MDD).
inline constexpr std::string_view own_mark = "written by furrow";
/// The mark as a comment of OBJ and OFF.
inline std::string own_comment() { return "# " + std::string(own_mark) + "\n"; }

/// The mark behind what the head of a file announces; of whole words of 4 bytes.
inline constexpr std::string_view own_tail{"written by furrow\0\0\0", 20};

/// The chunk of text before the end of a PNG, "Software: furrow", and what that end is.
inline constexpr std::string_view png_mark{"\0\0\0\017tEXtSoftware\0furrow\x84\xc4\x9b\xbd", 27};
inline constexpr std::string_view png_end{"\0\0\0\0IEND\xae\x42\x60\x82", 12};

/// What JSON of ours has under "generator".
inline constexpr const char* own_generator = "furrow";

}  // namespace furrow::io
