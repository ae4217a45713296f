# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(io LIBRARIES furrow::io nlohmann_json::nlohmann_json SOURCES
  animation_file_test.cpp
  assimp_reader_test.cpp
  atomic_file_test.cpp
  baked_maps_test.cpp
  chain_segments_test.cpp
  child_process_test.cpp
  damaged_files_test.cpp
  field_file_test.cpp
  frame_source_test.cpp
  glb_writer_test.cpp
  hostile_files_test.cpp
  obj_test.cpp
  off_test.cpp
  ply_test.cpp
  real_files_test.cpp
  scene_file_test.cpp
  soup_to_mesh_test.cpp
  state_file_test.cpp
  wrinkle_record_test.cpp
  stl_test.cpp
  stroke_file_test.cpp
  drawn_stroke_test.cpp
  resolve_strokes_test.cpp
  text_scanner_test.cpp
  triangulate_polygon_test.cpp
)
