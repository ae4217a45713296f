# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the reference in the build tree; any warning fails.
cmake_minimum_required(VERSION 3.25)
file(WRITE ${BINARY}/Doxyfile "@INCLUDE = docs/Doxyfile\nOUTPUT_DIRECTORY = ${BINARY}/doxygen\n")
execute_process(COMMAND ${DOXYGEN} ${BINARY}/Doxyfile WORKING_DIRECTORY ${ROOT} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out)
if(NOT result EQUAL 0 OR NOT EXISTS ${BINARY}/doxygen/html/classfurrow_1_1physics_1_1DistanceField.html)
  message(FATAL_ERROR "doxygen:\n${out}")
endif()
