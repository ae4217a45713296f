# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(jobs jobs LIBRARIES furrow::jobs SOURCES
  job_folders.h
  recorder.h
  chart_test.cpp
  keep_test.cpp
  listener_test.cpp
  mesh_input_test.cpp
  simulate_test.cpp
  wrinkle_test.cpp
)
