// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <utility>

namespace furrow::geometry {

/// A T by value in a struct that many include: T is only declared there, and copied and destroyed where it is
/// known (owned_members.h). It converts to a T& wherever one is wanted; *owned and owned-> are that T, too.
/// What was moved from is T().
template <class T>
class Owned {
 public:
  Owned() = default;  ///< T()
  Owned(T value);
  Owned(const Owned& other);
  Owned(Owned&& other) noexcept : value_(std::exchange(other.value_, nullptr)) {}
  Owned& operator=(Owned other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  ~Owned();

  T& operator*() { return value_ ? *value_ : made(); }
  const T& operator*() const {
    const T* value = value_;
    return value ? *value : fresh();
  }
  T* operator->() { return &**this; }
  const T* operator->() const { return &**this; }
  template <class Key>
  decltype(auto) operator[](Key&& key) {
    return (**this)[std::forward<Key>(key)];
  }
  template <class Key>
  decltype(auto) operator[](Key&& key) const {
    return (**this)[std::forward<Key>(key)];
  }
  operator T&() & { return **this; }
  operator const T&() const& { return **this; }
  operator T&&() && { return static_cast<T&&>(**this); }

 private:
  T& made();
  static const T& fresh();

  T* value_ = nullptr;  ///< null: T()
};

}  // namespace furrow::geometry
