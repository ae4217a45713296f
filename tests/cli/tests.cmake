# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(cli cli LIBRARIES furrow::io nlohmann_json::nlohmann_json SOURCES
  run_furrow.h
  run_furrow.cpp
  batch_test.cpp
  body_test.cpp
  doctor_test.cpp
  quality_test.cpp
  gate_test.cpp
  json_schema.h
  json_schema.cpp
  strict_json_test.cpp
  usage_test.cpp
  messages_test.cpp
  completion_test.cpp
  summary_test.cpp
  mistakes_test.cpp
  picture_options_test.cpp
  pipeline_test.cpp
  resume_test.cpp
  scene_outputs_test.cpp
  validation_scenes_test.cpp
  chart_test.cpp
  keep_test.cpp
  plate_test.cpp
  rest_keep_test.cpp
  transfer_test.cpp
  drape_test.cpp
  fabric_test.cpp
  fit_test.cpp
  strokes_test.cpp
  outputs_test.cpp
  hostile_files_test.cpp
  RELEASE_SOURCES
  sizes_test.cpp
)
add_dependencies(test_cli furrow)
