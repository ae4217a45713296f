# SPDX-License-Identifier: GPL-3.0-or-later
if(furrow_studio)
  furrow_add_tests(studio studio LIBRARIES furrow::studio Boost::headers SOURCES
    cloth_test.cpp failing_disk.cpp failing_disk.h hostile_test.cpp lines_test.cpp project_test.cpp protocol_test.cpp
    replay_test.cpp rooms_test.cpp studio_test.cpp)
  # Has functions of the system's names.
  set_source_files_properties(studio/failing_disk.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  # In a real browser; 77: there is none.
  if(NOT FURROW_SANITIZE)
    add_test(NAME studio_browser COMMAND ${FURROW_NODE} ${CMAKE_CURRENT_SOURCE_DIR}/studio/browser_test.mjs
      $<TARGET_FILE:furrow> ${PROJECT_SOURCE_DIR}/meshes ${furrow_page} ${PROJECT_BINARY_DIR}/studio-pictures)
    # The longest test begins first.
    set_tests_properties(studio_browser PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 1800 COST 1000)
  endif()
endif()
