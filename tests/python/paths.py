# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the tests find what they read."""
import os
import pathlib

SOURCE = pathlib.Path(__file__).resolve().parents[2]
MESHES = SOURCE / "meshes"
PROGRAM = os.environ.get("FURROW_PROGRAM", "")  # the command line of the same build; "": not compared
