# SPDX-License-Identifier: GPL-3.0-or-later
# Tests of the Python package, where it is built (cmake/python.cmake): unittest, of Python itself. Those that need meshio,
# mypy or pip say so when they skip.
if(furrow_python)
  foreach(name meshes doors jobs stubs examples pip)
    add_test(NAME "python: ${name}" COMMAND ${Python_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/python/${name}_test.py)
    set_tests_properties("python: ${name}" PROPERTIES ENVIRONMENT
      "PYTHONPATH=${PROJECT_BINARY_DIR}/python;FURROW_PROGRAM=$<TARGET_FILE:furrow>;FURROW_BUILD=${PROJECT_BINARY_DIR}")
  endforeach()
endif()
