// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer's entry for one reader, that of FUZZ_FORMAT in the environment; scripts/fuzz builds and runs it.
// A reader may refuse its bytes as content or as a wrong option; anything else is a finding.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "tests/fuzz/read_format.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const char* const format = std::getenv("FUZZ_FORMAT");
  if (!format) std::abort();
  furrow::fuzz::reads(format, std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
