# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(field LIBRARIES furrow::physics CGAL::CGAL SOURCES
  triangle_bvh_test.cpp
  winding_number_test.cpp
  compare_colliders_test.cpp
  depth_map_collider_test.cpp
  exact_distance_test.cpp
  distance_field_at_many_test.cpp
  distance_field_smooth_test.cpp
  distance_field_test.cpp
  distance_field_bytes_test.cpp
  distance_field_progress_test.cpp
)
