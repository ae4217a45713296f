# SPDX-License-Identifier: GPL-3.0-or-later
# What every target of ours compiles with. No global flags: targets link furrow_options.
add_library(furrow_options INTERFACE)
target_compile_features(furrow_options INTERFACE cxx_std_20)
configure_file(${CMAKE_CURRENT_LIST_DIR}/version.h.in ${PROJECT_BINARY_DIR}/generated/furrow/version.h @ONLY)
target_include_directories(furrow_options INTERFACE $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>)
target_include_directories(furrow_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
# The same input gives the same bits: no contraction of a*b+c that depends on the compiler's mood.
target_compile_options(furrow_options INTERFACE -ffp-contract=off)
target_compile_options(furrow_options INTERFACE
  $<BUILD_INTERFACE:-fno-math-errno -Wall -Wextra -Wshadow -Wnon-virtual-dtor>
  # United sources shadow what their neighbours in the room call so, and are included.
  $<BUILD_INTERFACE:$<$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>:-Wno-shadow$<$<CXX_COMPILER_ID:GNU>:$<SEMICOLON>-Wno-subobject-linkage>>>)
if(FURROW_WERROR)
  target_compile_options(furrow_options INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
if(FURROW_SANITIZE)
  # These four checks make g++ take minutes and gigabytes for one CGAL source; the rest stay on.
  set(furrow_sanitizers -fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,vptr
      -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_compile_options(furrow_options INTERFACE $<BUILD_INTERFACE:${furrow_sanitizers}>)
  target_link_options(furrow_options INTERFACE $<BUILD_INTERFACE:${furrow_sanitizers}>)
  target_compile_definitions(furrow_options INTERFACE $<BUILD_INTERFACE:FURROW_SANITIZED>)
endif()

# What spends its time in the libraries and not in itself (the program, the tests) is compiled faster, not better.
set(furrow_light_options $<IF:$<CONFIG:Debug>,-O0,-O1>)

# furrow_sources(OUT): all sources and headers of this folder and its rooms, by name: a new one is listed nowhere.
function(furrow_sources out)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} *.h *.cpp)
  set(${out} ${sources} PARENT_SCOPE)
endfunction()

# furrow_add_library(NAME): a static library `furrow::NAME` of this folder, a component of the package.
function(furrow_add_library name)
  furrow_sources(sources)
  add_library(${name} STATIC ${sources})
  add_library(furrow::${name} ALIAS ${name})
  set_target_properties(${name} PROPERTIES OUTPUT_NAME furrow_${name} EXPORT_NAME ${name}
                        POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(${name} PUBLIC $<BUILD_INTERFACE:furrow_options>)
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_compile_options(${name} INTERFACE $<INSTALL_INTERFACE:-ffp-contract=off>)
  # Optimised, the library of physics stays apart: where time is measured, what is tested is what users build.
  if(CMAKE_BUILD_TYPE STREQUAL Debug OR NOT name STREQUAL physics)
    furrow_unite(${name})
  endif()
endfunction()

# furrow_public_headers(NAME HEADERS…): the doors of this folder, which are installed and documented; all its other headers
# are private. A public header includes public ones only (the test `public_headers`).
function(furrow_public_headers name)
  target_sources(${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${ARGN})
endfunction()

# Most of a source's time goes into the headers of CGAL, Eigen and Catch2: targets parse them once, or reuse what another
# target with the same options parsed. furrow_precompile(TARGET HEADERS…) or furrow_precompile(TARGET REUSE_FROM OTHER).
# (ccache needs -fpch-preprocess to see through it.)
function(furrow_precompile target)
  if(ARGV1 STREQUAL REUSE_FROM)
    target_precompile_headers(${target} REUSE_FROM ${ARGV2})
  else()
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()
set(furrow_mesh_headers ${PROJECT_SOURCE_DIR}/geometry/mesh/mesh.h <Eigen/Core> <algorithm> <functional> <map> <optional> <set>
                        <span> <sstream> <stdexcept> <string> <unordered_map> <vector>)

# furrow_unite(TARGET): with FURROW_UNITY, up to FURROW_UNITY_SIZE sources of a room are compiled as one, so that what they
# include is parsed and instantiated once. (CMake leaves out sources with options of their own.) Names in their anonymous
# namespaces must differ.
function(furrow_unite target)
  if(NOT FURROW_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH room)
    string(MAKE_C_IDENTIFIER "in_${room}" room)
    math(EXPR ${room} "${${room}} + 1")
    math(EXPR part "(${${room}} + ${FURROW_UNITY_SIZE} - 1) / ${FURROW_UNITY_SIZE}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room}_${part})
  endforeach()
endfunction()
