# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(render io LIBRARIES furrow::io SOURCES
  base/camera_test.cpp
  picture/box_filter_test.cpp
  picture/fit_colours_test.cpp
  picture/png_file_test.cpp
  picture/prepared_scene_test.cpp
  picture/render_errors_test.cpp
  picture/render_scene_test.cpp
  picture/render_slice_test.cpp
  picture/render_test.cpp
  picture/render_weave_test.cpp
  picture/strip_test.cpp
  picture/stroke_font_test.cpp
  picture/thicken_test.cpp
  picture/tile_test.cpp
  picture/texture_test.cpp
)
