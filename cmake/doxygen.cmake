# SPDX-License-Identifier: GPL-3.0-or-later
# The Doxyfile of this build: that of docs/, for the public headers. `doxygen build/release/Doxyfile` from the root.
set(furrow_doxygen_input README.md CONTRIBUTING.md CHANGELOG.md docs decisions)
foreach(library IN LISTS furrow_libraries)
  if(TARGET ${library})
    if(EXISTS ${PROJECT_SOURCE_DIR}/${library}/README.md)
      list(APPEND furrow_doxygen_input ${library}/README.md)
    endif()
    get_target_property(headers ${library} HEADER_SET)
    list(TRANSFORM headers REPLACE "^${PROJECT_SOURCE_DIR}/" "")
    list(APPEND furrow_doxygen_input ${headers})
  endif()
endforeach()
list(JOIN furrow_doxygen_input " \\\n  " furrow_doxygen_input)
file(RELATIVE_PATH furrow_doxygen_up ${PROJECT_BINARY_DIR}/doxygen/html ${PROJECT_SOURCE_DIR})
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/Doxyfile @ONLY CONTENT "@INCLUDE = docs/Doxyfile
OUTPUT_DIRECTORY = @PROJECT_BINARY_DIR@/doxygen
USE_MDFILE_AS_MAINPAGE = @PROJECT_SOURCE_DIR@/README.md
INPUT = @furrow_doxygen_input@
FILTER_PATTERNS = \"*.md=sh docs/doxygen-links @furrow_doxygen_up@\"
")
