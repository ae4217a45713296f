# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(render LIBRARIES furrow::io SOURCES
  png_file_test.cpp
  camera_test.cpp
  prepared_scene_test.cpp
  render_test.cpp
  render_errors_test.cpp
  render_scene_test.cpp
  stroke_font_test.cpp
  strip_test.cpp
  fit_colours_test.cpp
  texture_test.cpp
)
