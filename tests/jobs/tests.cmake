# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(jobs jobs LIBRARIES furrow::jobs SOURCES
  job_folders.h
  recorder.h
  bake_test.cpp
  chart_test.cpp
  contact_gap_test.cpp
  doctor_test.cpp
  drape_layers_test.cpp
  drape_test.cpp
  field_test.cpp
  fit_test.cpp
  gate_test.cpp
  keep_test.cpp
  listener_test.cpp
  mesh_input_test.cpp
  own_output_test.cpp
  quality_test.cpp
  seam_ties_test.cpp
  simulate_test.cpp
  smooth_test.cpp
  stroke_list_test.cpp
  subdivide_test.cpp
  transfer_test.cpp
  wrinkle_test.cpp
)
