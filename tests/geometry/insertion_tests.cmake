# SPDX-License-Identifier: GPL-3.0-or-later
# Strokes and Algorithm 2.
furrow_add_tests(insertion LIBRARIES furrow::io SOURCES
  flip_rules_test.cpp
  insert_along_stroke_test.cpp
  insert_in_faces_test.cpp
  insertion_checks.cpp
  insertion_checks.h
  insertion_meshes.cpp
  insertion_meshes.h
  insertion_table_test.cpp
  irregular_sheet.cpp
  random_strokes_test.cpp
  real_garments_test.cpp
  rest_metric_test.cpp
  seams_test.cpp
  trace_stroke_test.cpp
)
