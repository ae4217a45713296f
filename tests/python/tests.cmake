# SPDX-License-Identifier: GPL-3.0-or-later
# Tests of the Python package, where it is built (cmake/python.cmake): unittest, of Python itself.
if(furrow_python)
  foreach(name meshes jobs)
    add_test(NAME "python: ${name}" COMMAND ${Python_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/python/${name}_test.py)
    set_tests_properties("python: ${name}" PROPERTIES ENVIRONMENT
      "PYTHONPATH=${PROJECT_BINARY_DIR}/python;FURROW_PROGRAM=$<TARGET_FILE:furrow>")
  endforeach()
endif()
