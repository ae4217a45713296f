// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "jobs/base/inputs.h"

/// What can be known to fail when a file is written is said before the work.
namespace furrow::jobs {

/// Throws std::runtime_error for a file in a folder that does not exist.
void check_folder(const std::string& path);
/// Throws std::invalid_argument for a mesh that could not be written in the end: a format that is read only;
/// and as check_folder().
void check_output(const std::string& path);
/// Throws std::invalid_argument, naming the option, for a picture that is not named as a PNG; and as
/// check_folder(). An empty path is passed over.
void check_picture(const std::string& path, const std::string& option);

/// Whether two names are those of one file, which need not be there yet.
bool same_file(const std::string& a, const std::string& b);
/// Throws std::invalid_argument if the output would replace a file that is read or written beside it.
void refuse_same(const std::string& output, const std::string& other);
/// The same for each output against every input and every other output; "-" among the inputs, and empty
/// names, are passed over.
void refuse_same(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

/// What every job asks of its outputs: as refuse_same(); and throws std::invalid_argument for one that is
/// there and that furrow did not write (own_output.h), unless the listener replaces it. "-", and what is no
/// regular file, is passed over.
void check_replaced(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs,
                    Listener& listener);

}  // namespace furrow::jobs
