# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(field physics LIBRARIES furrow::physics SOURCES
  body/compare_colliders_test.cpp
  body/corner_cones_test.cpp
  body/depth_map_collider_test.cpp
  body/distance_field_bytes_test.cpp
  body/distance_field_progress_test.cpp
  body/distance_field_smooth_test.cpp
  body/distance_field_test.cpp
  body/exact_distance_test.cpp
  body/moved_distance_test.cpp
  body/lattice_samples_test.cpp
  body/triangle_bvh_test.cpp
  body/winding_number_test.cpp
)
