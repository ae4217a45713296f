# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(geometry LIBRARIES furrow::geometry SOURCES
  edge_metric_test.cpp
  displace_line_test.cpp
  two_ring_test.cpp
  taubin_smooth_test.cpp
  bending_springs_test.cpp
  rest_angles_test.cpp
  rest_state_test.cpp
  masses_test.cpp
  stiffness_test.cpp
  line_height_test.cpp
  subdivide_test.cpp
  vertex_attributes_test.cpp
  transfer_shape_test.cpp
  bake_maps_test.cpp
  border_loops_test.cpp
  measures_test.cpp
  self_intersections_test.cpp
  repair_body_test.cpp
  select_vertices_test.cpp
  sheet_test.cpp
  place_view_stroke_test.cpp
  place_texture_stroke_test.cpp
  place_path_stroke_test.cpp
  wrinkle_test.cpp
)
