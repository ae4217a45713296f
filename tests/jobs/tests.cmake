# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(jobs jobs LIBRARIES furrow::jobs SOURCES
  job_folders.h
  recorder.h
  chart_test.cpp
  keep_test.cpp
  listener_test.cpp
  mesh_input_test.cpp
  simulate_test.cpp
  wrinkle_test.cpp
)
add_executable(simulate_job ${PROJECT_SOURCE_DIR}/examples/simulate_job.cpp)  # a whole job in twenty lines
target_compile_options(simulate_job PRIVATE ${furrow_light_options})
target_link_libraries(simulate_job PRIVATE furrow::jobs)
add_test(NAME "jobs: the example runs a scene"
         COMMAND simulate_job ${PROJECT_SOURCE_DIR}/scenes/validation/free_fall.toml)
