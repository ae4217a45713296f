# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(io io LIBRARIES furrow::io nlohmann_json::nlohmann_json)
