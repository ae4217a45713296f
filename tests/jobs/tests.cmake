# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(jobs jobs LIBRARIES furrow::jobs cases)
