// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer's entry for one reader, that of FUZZ_FORMAT; scripts/fuzz builds and runs it. A reader may refuse
// its bytes as content or as a wrong option; anything else is a finding.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/read_format.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  furrow::fuzz::reads(FUZZ_FORMAT, std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
