# SPDX-License-Identifier: GPL-3.0-or-later
# Whether the Python package `furrow` is built (python/). FURROW_PYTHON: AUTO builds it with the whole tree where pybind11 and
# numpy are found, but not under the sanitizers, which Python itself is not built with; ON, or the component `python` named
# in FURROW_COMPONENTS, fails where they are not.
set(FURROW_PYTHON AUTO CACHE STRING "Build the Python package: AUTO, ON or OFF (needs python3-dev, pybind11-dev, python3-numpy)")
set_property(CACHE FURROW_PYTHON PROPERTY STRINGS AUTO ON OFF)
set(furrow_python OFF)

# furrow_find_python(WHY): finds Python and pybind11; sets WHY to what is missing, or to "". The system's Python goes first:
# another one may stand first in PATH, for which Debian's packages are not there.
macro(furrow_find_python why)
  set(${why} "")
  if(NOT Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that the package is built for")
  endif()
  find_package(Python 3.9 COMPONENTS Interpreter Development.Module)
  set(PYBIND11_FINDPYTHON ON)
  find_package(pybind11 2.10 CONFIG)
  if(NOT Python_FOUND)
    set(${why} "Python 3.9 with its headers is not found: install python3-dev")
  elseif(NOT pybind11_FOUND)
    set(${why} "pybind11 2.10 is not found: install pybind11-dev")
  else()
    execute_process(COMMAND ${Python_EXECUTABLE} -c "import numpy" RESULT_VARIABLE furrow_numpy ERROR_QUIET)
    if(NOT furrow_numpy EQUAL 0)
      set(${why} "${Python_EXECUTABLE} has no numpy: install python3-numpy")
    endif()
  endif()
endmacro()

if(python IN_LIST furrow_built OR (FURROW_PYTHON AND furrow_whole))  # AUTO is true
  if(FURROW_PYTHON STREQUAL AUTO AND FURROW_SANITIZE)
    set(furrow_why "Python is not built with the sanitizers")
  elseif(NOT FURROW_PYTHON)
    set(furrow_why "FURROW_PYTHON=OFF")
  else()
    furrow_find_python(furrow_why)
  endif()
  if(furrow_why STREQUAL "")
    set(furrow_python ON)
  elseif(FURROW_PYTHON STREQUAL AUTO AND NOT python IN_LIST furrow_built)
    message(STATUS "the Python package is left out: ${furrow_why}")
  else()
    message(FATAL_ERROR "the Python package cannot be built: ${furrow_why}; or set FURROW_PYTHON=OFF, and leave python out of FURROW_COMPONENTS")
  endif()
endif()
if(furrow_python AND NOT python IN_LIST furrow_built)
  list(APPEND furrow_built python)
endif()
set(furrow_python_files __init__.py __init__.pyi py.typed)  # beside the module
set(FURROW_PYTHON_FOLDER lib/python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}/dist-packages CACHE STRING
    "Where the Python package is installed to, below the prefix")
