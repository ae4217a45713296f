// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing: its target holds the precompiled headers of the tests that see the half-edge structure.
