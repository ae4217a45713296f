# SPDX-License-Identifier: GPL-3.0-or-later
# `cpack` in the build folder (scripts/package does it) makes one Debian package of what the target `furrow` builds: the program
# with its man pages, completion, gallery and docs, and the libraries with their headers. The package of Python comes by pip.
if(NOT furrow_whole)
  return()
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Furrow authors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL ${furrow_libraries} program docs)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# `furrow chart` draws by gnuplot; the others are for programs on the libraries.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "gnuplot-nox, libeigen3-dev, libmetis-dev, libcgal-dev, libassimp-dev, libdraco-dev, libmeshoptimizer-dev, libembree-dev, \
libpng-dev, nlohmann-json3-dev, libtomlplusplus-dev, libfmt-dev")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Ridge and valley lines become wrinkles of a finished 3D garment; physics settles the cloth on its body.
 The program, its studio with a gallery, and the C++ libraries with their headers.")
include(CPack)
