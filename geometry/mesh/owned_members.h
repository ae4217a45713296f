// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/owned.h"

/// What an Owned<T> does with its T. A source that knows T instantiates it: `template class Owned<Mesh>;`
namespace furrow::geometry {

template <class T>
Owned<T>::Owned(T value) : value_(new T(std::move(value))) {}
template <class T>
Owned<T>::Owned(const Owned& other) : value_(other.value_ ? new T(*other.value_) : nullptr) {}
template <class T>
Owned<T>::~Owned() {
  delete value_;
}
template <class T>
T& Owned<T>::made() {
  return *(value_ = new T());
}
template <class T>
const T& Owned<T>::fresh() {
  static const T value{};
  return value;
}

}  // namespace furrow::geometry
