# SPDX-License-Identifier: GPL-3.0-or-later
if(furrow_studio)
  furrow_add_tests(studio studio LIBRARIES furrow::studio Boost::headers SOURCES
    cloth_test.cpp failing_disk.cpp failing_disk.h hostile_test.cpp lines_test.cpp project_test.cpp protocol_test.cpp
    replay_test.cpp rooms_test.cpp studio_test.cpp touch_test.cpp)
  # Has functions of the system's names.
  set_source_files_properties(studio/failing_disk.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  add_test(NAME page_layout COMMAND ${FURROW_NODE} node_modules/prettier/bin/prettier.cjs --check src
                            WORKING_DIRECTORY ${furrow_page})
  # In a real browser; 77: there is none. The longest tests begin first.
  if(NOT FURROW_SANITIZE)
    set(studio_browser studio/browser_test.mjs)
    set(studio_pen studio/pen_test.mjs)
    set(studio_journeys journeys/studio_journeys.mjs)
    foreach(test studio_browser studio_pen studio_journeys)
      add_test(NAME ${test} COMMAND ${FURROW_NODE} ${CMAKE_CURRENT_SOURCE_DIR}/${${test}}
        $<TARGET_FILE:furrow> ${PROJECT_SOURCE_DIR}/meshes ${furrow_page} ${PROJECT_BINARY_DIR}/studio-pictures)
      set_tests_properties(${test} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 1800 COST 1000)
    endforeach()
  endif()
endif()
