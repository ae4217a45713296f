# SPDX-License-Identifier: GPL-3.0-or-later
# Strokes and Algorithm 2.
furrow_add_tests(insertion LIBRARIES furrow::geometry SOURCES
  insertion_checks.cpp
  insertion_checks.h
  insertion_meshes.cpp
  insertion_meshes.h
  random_strokes_test.cpp
)
