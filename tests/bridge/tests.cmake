# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(bridge bridge LIBRARIES furrow::bridge garment_cases SOURCES
  couple_bending_test.cpp
  drape_test.cpp
  draw_more_test.cpp
  energy_parts_test.cpp
  fit_ease_test.cpp
  fit_piercing_test.cpp
  fit_report_test.cpp
  fit_zones_test.cpp
  gather_test.cpp
  woven_gather_test.cpp
  keep_lines_test.cpp
  keep_verdicts_test.cpp
  line_help_test.cpp
  place_noise_test.cpp
  reactions_test.cpp
  store_rest_state_test.cpp
  tension_constants_test.cpp
  body_test.cpp
  posed_body_test.cpp
  RELEASE_SOURCES
  draped_test.cpp
  garment_rest_test.cpp
)
