# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(meshes meshes LIBRARIES furrow::io SOURCES figure_test.cpp)
# Seven seconds. The functions behind the figure take no more than + - * / and square roots, so it should have the same
# bits wherever CGAL is of the same version; the sanitizers would need minutes.
if(NOT FURROW_SANITIZE)
  add_dependencies(test_meshes make_meshes)
  add_test(NAME made_meshes
           COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:make_meshes> -DCOMMITTED=${PROJECT_SOURCE_DIR}/meshes
                   -DOUTPUT=${PROJECT_BINARY_DIR}/made_meshes -P ${CMAKE_CURRENT_SOURCE_DIR}/meshes/check_meshes.cmake)
endif()
