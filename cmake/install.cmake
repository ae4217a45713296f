# SPDX-License-Identifier: GPL-3.0-or-later
# `cmake --install build` installs all that was built; `--component physics` one part of it (what that stands on is a
# component of its own).
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/furrow)
set(furrow_headers_folder ${CMAKE_INSTALL_INCLUDEDIR}/furrow)
configure_package_config_file(cmake/furrow-config.cmake.in furrow-config.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(furrow-config-version.cmake COMPATIBILITY SameMinorVersion)

foreach(component IN LISTS furrow_built)
  set(licence LICENSE)
  set(licence_folder ${CMAKE_INSTALL_DOCDIR})
  if(component STREQUAL program)
    install(TARGETS furrow RUNTIME COMPONENT program)
    # Of furrow body, and of the studio's gallery.
    install(FILES meshes/mannequin.obj DESTINATION ${CMAKE_INSTALL_DATADIR}/furrow/meshes COMPONENT program)
    if(furrow_studio)  # of what is in the page
      install(FILES ${furrow_page}/licences.txt DESTINATION ${CMAKE_INSTALL_DOCDIR}/studio COMPONENT program)
      # Its gallery, whose scenes name the meshes by relative paths.
      install(DIRECTORY scenes/studio DESTINATION ${CMAKE_INSTALL_DATADIR}/furrow/scenes COMPONENT program)
      install(FILES meshes/skirt.obj meshes/shirt.obj meshes/hung_sheet.obj
              DESTINATION ${CMAKE_INSTALL_DATADIR}/furrow/meshes COMPONENT program)
      install(FILES meshes/strokes/figure_skirt.json DESTINATION ${CMAKE_INSTALL_DATADIR}/furrow/meshes/strokes
              COMPONENT program)
    endif()
    if(NOT CMAKE_CROSSCOMPILING)
      set(words ${PROJECT_BINARY_DIR}/words)
      install(DIRECTORY ${words}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program FILES_MATCHING PATTERN "*.1")
      install(FILES ${words}/furrow DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
      install(FILES ${words}/_furrow DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT program)
      install(FILES ${words}/furrow.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
    endif()
  elseif(component STREQUAL python)
    set(python_folder ${FURROW_PYTHON_FOLDER}/furrow)
    # Where the program alone was built there is no module, and its package is left out.
    install(TARGETS python LIBRARY DESTINATION ${python_folder} COMPONENT python OPTIONAL)
    list(TRANSFORM furrow_python_files PREPEND ${PROJECT_SOURCE_DIR}/python/src/furrow/)
    install(CODE "if(EXISTS \"$<TARGET_FILE:python>\")
  file(INSTALL ${furrow_python_files} DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${python_folder}\")
endif()" COMPONENT python)
  else()
    install(TARGETS ${component} EXPORT furrow_${component}
            ARCHIVE COMPONENT ${component}
            FILE_SET HEADERS DESTINATION ${furrow_headers_folder} COMPONENT ${component})
    install(EXPORT furrow_${component} NAMESPACE furrow:: FILE furrow-${component}-targets.cmake
            DESTINATION ${package} COMPONENT ${component})
    install(FILES ${PROJECT_BINARY_DIR}/generated/furrow/version.h DESTINATION ${furrow_headers_folder}/furrow
            COMPONENT ${component})
    install(FILES ${PROJECT_BINARY_DIR}/furrow-config.cmake ${PROJECT_BINARY_DIR}/furrow-config-version.cmake
            DESTINATION ${package} COMPONENT ${component})
  endif()
  if(component STREQUAL jobs)
    install(FILES jobs/report.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/furrow COMPONENT jobs)
  endif()
  if(component STREQUAL physics)
    install(FILES cmake/FindMETIS.cmake DESTINATION ${package} COMPONENT physics)
    install(FILES physics/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/physics COMPONENT physics)
    set(licence physics/LICENSE)
    set(licence_folder ${CMAKE_INSTALL_DOCDIR}/physics)
  endif()
  install(FILES ${licence} DESTINATION ${licence_folder} COMPONENT ${component})
endforeach()
if(furrow_whole)
  install(FILES README.md CHANGELOG.md CITATION.cff CONTRIBUTING.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT docs)
  install(DIRECTORY docs decisions examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT docs PATTERN Doxyfile EXCLUDE)
endif()

# pkg-config, where no CMake is used. Its paths begin at the file itself, so that the whole prefix may be moved.
file(RELATIVE_PATH furrow_pc_up /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
string(REGEX REPLACE "/$" "" furrow_pc_up "${furrow_pc_up}")
foreach(folder LIBDIR INCLUDEDIR)
  set(furrow_pc_${folder} "\${prefix}/${CMAKE_INSTALL_${folder}}")
  if(IS_ABSOLUTE ${CMAKE_INSTALL_${folder}})
    set(furrow_pc_${folder} ${CMAKE_INSTALL_${folder}})
  endif()
endforeach()
if(physics IN_LIST furrow_built)
  get_filename_component(furrow_pc_metis "${METIS_LIBRARY}" DIRECTORY)
  configure_file(cmake/furrow-physics.pc.in furrow-physics.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/furrow-physics.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT physics)
endif()
