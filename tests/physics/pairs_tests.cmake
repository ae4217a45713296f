# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(pairs physics LIBRARIES furrow::physics cases SOURCES
  pairs/barrier_test.cpp
  pairs/box_tree_test.cpp
  pairs/cloth_contact_test.cpp
  pairs/edge_face_crossings_test.cpp
  pairs/pair_bounds_test.cpp
  pairs/pair_curvature_test.cpp
  pairs/pair_distance_test.cpp
  pairs/pair_friction_test.cpp
  pairs/pair_list_test.cpp
  pairs/pair_mesh_test.cpp
  pairs/pair_pushes_test.cpp
  pairs/pair_search_test.cpp
  pairs/time_of_impact_test.cpp
  pairs/untangle_contours_test.cpp
  pairs/untangle_layers_test.cpp
  rest/displace_pairs_test.cpp
  rest/settle_layers_test.cpp
  rest/settle_pairs_test.cpp
)
