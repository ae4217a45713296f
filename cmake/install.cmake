# SPDX-License-Identifier: GPL-3.0-or-later
include(CMakePackageConfigHelpers)
get_property(libraries GLOBAL PROPERTY furrow_libraries)
install(TARGETS ${libraries} furrow_options EXPORT furrow_targets)
install(EXPORT furrow_targets NAMESPACE furrow:: FILE furrow-targets.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/furrow)
foreach(folder geometry physics bridge io)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/furrow FILES_MATCHING PATTERN "*.h")
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/generated/furrow/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/furrow/furrow)
configure_package_config_file(cmake/furrow-config.cmake.in furrow-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/furrow)
write_basic_package_version_file(furrow-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/furrow-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/furrow-config-version.cmake cmake/FindMETIS.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/furrow)
install(TARGETS furrow RUNTIME)
