# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(cli cli LIBRARIES furrow::io nlohmann_json::nlohmann_json RELEASE_SOURCES
  sizes_test.cpp
)
add_dependencies(test_cli furrow)
