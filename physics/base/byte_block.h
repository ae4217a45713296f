// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace furrow::physics {

/// Appends numbers of fixed size to a block, little-endian on every machine.
class ByteWriter {
 public:
  template <class T>
  void put(T value) {
    static_assert(std::is_arithmetic_v<T>);
    std::byte bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i)
      block_.push_back(bytes[std::endian::native == std::endian::little ? i : sizeof(T) - 1 - i]);
  }
  std::vector<std::byte> take() { return std::move(block_); }

 private:
  std::vector<std::byte> block_;
};

/// Reads them back; std::invalid_argument at the end of the block.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> block) : block_(block) {}

  template <class T>
  T get() {
    static_assert(std::is_arithmetic_v<T>);
    if (left() < sizeof(T))
      throw std::invalid_argument("the block ends after " + std::to_string(at_) + " bytes");
    std::byte bytes[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i)
      bytes[std::endian::native == std::endian::little ? i : sizeof(T) - 1 - i] = block_[at_ + i];
    at_ += sizeof(T);
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }
  std::size_t left() const { return block_.size() - at_; }

 private:
  std::span<const std::byte> block_;
  std::size_t at_ = 0;
};

}  // namespace furrow::physics
