// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

/// Numbers in a file's byte order, whatever the machine's is.
namespace furrow::io {

template <class T>
void append_in_order(std::string& out, T value, std::endian order) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (order != std::endian::native) std::ranges::reverse(bytes);
  out.append(bytes.data(), bytes.size());
}

/// `at` has sizeof(T) bytes.
template <class T>
T read_in_order(const char* at, std::endian order) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, bytes.size());
  if (order != std::endian::native) std::ranges::reverse(bytes);
  return std::bit_cast<T>(bytes);
}

}  // namespace furrow::io
