# SPDX-License-Identifier: GPL-3.0-or-later
# CITATION.cff has what CFF 1.2.0 asks for, and the version of CMakeLists.txt.
cmake_minimum_required(VERSION 3.25)
file(READ ${ROOT}/CITATION.cff text)
foreach(line "cff-version: 1.2.0" "message: [^\n]+" "title: [^\n]+" "type: software" "version: ${VERSION}" "license: GPL-3.0-or-later"
             "authors:" "references:")
  if(NOT text MATCHES "\n${line}\n")
    message(FATAL_ERROR "CITATION.cff has no line '${line}'")
  endif()
endforeach()
