# SPDX-License-Identifier: GPL-3.0-or-later
# Whether `furrow studio` is built, and the page that it serves: sources of studio/page, bundled by npm's packages as
# package-lock.json has them, become one source of the program, which then needs neither Node nor a network.
# FURROW_STUDIO: AUTO builds it where Node 18 and npm are found and the packages can be had; ON fails where not.
set(FURROW_STUDIO AUTO CACHE STRING "Build furrow studio, the page for drawing: AUTO, ON or OFF (needs node and npm)")
set_property(CACHE FURROW_STUDIO PROPERTY STRINGS AUTO ON OFF)
set(furrow_studio OFF)
set(furrow_page ${PROJECT_BINARY_DIR}/page)

# furrow_find_studio(WHY): sets WHY to what is missing, or to "".
function(furrow_find_studio why)
  find_program(FURROW_NODE NAMES node nodejs)
  find_program(FURROW_NPM npm)
  find_package(Boost 1.74)
  if(NOT FURROW_NODE OR NOT FURROW_NPM)
    set(${why} "node and npm are not found: install nodejs and npm" PARENT_SCOPE)
    return()
  endif()
  if(NOT Boost_FOUND)
    set(${why} "Boost 1.74 is not found: install libboost-dev" PARENT_SCOPE)
    return()
  endif()
  execute_process(COMMAND ${FURROW_NODE} -p "process.versions.node.split('.')[0]" OUTPUT_VARIABLE major
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT major GREATER_EQUAL 18)
    set(${why} "node is older than 18" PARENT_SCOPE)
    return()
  endif()
  # Packages are fetched once for each lock file.
  set(page ${PROJECT_SOURCE_DIR}/studio/page)
  file(SHA256 ${page}/package-lock.json lock)
  set(stamp ${furrow_page}/node_modules/.furrow-${lock})
  if(NOT EXISTS ${stamp})
    message(STATUS "furrow studio: fetching the packages of its page (npm ci)")
    file(MAKE_DIRECTORY ${furrow_page})
    file(COPY ${page}/package.json ${page}/package-lock.json DESTINATION ${furrow_page})
    execute_process(COMMAND ${FURROW_NPM} ci --ignore-scripts --prefer-offline --no-audit --no-fund
                    WORKING_DIRECTORY ${furrow_page} RESULT_VARIABLE failed OUTPUT_VARIABLE told ERROR_VARIABLE told
                    TIMEOUT 300)
    if(failed)
      string(REGEX REPLACE "\n.*" "" first "${told}")
      set(${why} "npm could not fetch the packages of its page (${first})" PARENT_SCOPE)
      return()
    endif()
    file(TOUCH ${stamp})
  endif()
  set(${why} "" PARENT_SCOPE)
endfunction()

if(FURROW_STUDIO)  # AUTO is true
  furrow_find_studio(why)
  if(why STREQUAL "")
    set(furrow_studio ON)
  elseif(FURROW_STUDIO STREQUAL AUTO)
    message(STATUS "furrow studio is left out: ${why}")
  else()
    message(FATAL_ERROR "FURROW_STUDIO=ON: ${why}; or set FURROW_STUDIO=OFF")
  endif()
endif()
