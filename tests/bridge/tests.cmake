# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(bridge bridge LIBRARIES furrow::bridge garment_cases SOURCES
  arrays/couple_bending_test.cpp
  draping/drape_test.cpp
  keeping/draw_more_test.cpp
  draping/energy_parts_test.cpp
  draping/fit_ease_test.cpp
  draping/fit_piercing_test.cpp
  draping/fit_report_test.cpp
  draping/fit_zones_test.cpp
  arrays/gather_riders_test.cpp
  arrays/gather_test.cpp
  arrays/woven_gather_test.cpp
  keeping/hold_lines_test.cpp
  keeping/keep_lines_test.cpp
  keeping/keep_verdicts_test.cpp
  keeping/line_help_test.cpp
  arrays/place_noise_test.cpp
  arrays/reactions_test.cpp
  arrays/store_rest_state_test.cpp
  arrays/tension_constants_test.cpp
  draping/body_test.cpp
  draping/posed_body_test.cpp
  draping/refine_where_test.cpp
  RELEASE_SOURCES
  draping/draped_test.cpp
  draping/garment_rest_test.cpp
)
