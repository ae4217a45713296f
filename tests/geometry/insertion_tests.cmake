# SPDX-License-Identifier: GPL-3.0-or-later
# Strokes and Algorithm 2.
furrow_add_tests(insertion geometry LIBRARIES furrow::io SOURCES
  stroke/trace_stroke_test.cpp
  rest/rest_metric_test.cpp
  insert/flip_rules_test.cpp
  insert/insert_along_stroke_test.cpp
  insert/insert_in_faces_test.cpp
  insert/insertion_checks.cpp
  insert/insertion_checks.h
  insert/insertion_meshes.cpp
  insert/insertion_meshes.h
  insert/insertion_table_test.cpp
  insert/irregular_sheet.cpp
  insert/random_strokes_test.cpp
  insert/seams_test.cpp
RELEASE_SOURCES
  fold/random_folds_test.cpp
  insert/real_garments_test.cpp
)
