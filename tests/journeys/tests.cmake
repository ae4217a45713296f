# SPDX-License-Identifier: GPL-3.0-or-later
# What users do, from end to end, with defaults, by the program alone. A journey is the run of programs that other tests
# take apart, and takes seconds: all are [release].
if(NOT FURROW_SANITIZE)
  furrow_add_tests(journeys journeys LIBRARIES furrow::io nlohmann_json::nlohmann_json SOURCES
    ../cli/run_furrow.cpp
    journey.h
    journey.cpp
    advice_test.cpp
    batch_test.cpp
    garments_test.cpp
    interrupted_test.cpp
    layers_test.cpp
    worn_lines_test.cpp
    rigged_test.cpp
    settled_lines_test.cpp
  )
  add_dependencies(test_journeys furrow)
  find_program(FURROW_BLENDER blender)
  if(FURROW_BLENDER)
    add_test(NAME journeys_blender COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/journeys/blender_addon $<TARGET_FILE:furrow>
                                           ${CMAKE_BINARY_DIR}/blender)
  else()
    message(STATUS "skipped: there is no blender, so its add-on is not tried (bench/interop/blender installs it)")
  endif()
endif()
