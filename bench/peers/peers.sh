# SPDX-License-Identifier: GPL-3.0-or-later
# What the scripts of this folder share, to be sourced: shell functions that time programs and read what they print.
# They expect `start`, the folder from which the script was called, and `work`, a folder for files.

at() { case $1 in /*) echo "$1" ;; *) echo "$start/$1" ;; esac; }
# Ends well, with a sentence, where there is nothing to compare with.
need_blender() {
  if ! command -v blender >/dev/null || ! /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
    echo "no Blender with NumPy here: nothing to compare with (Debian: apt-get install blender python3-numpy)"
    exit 0
  fi
}
# The first value of a key of JSON, in a file.
field() { sed -n "s/.*\"$1\": \([^,}]*\).*/\1/p" "$2" | head -n 1; }
# Processor seconds of a program, its output in $work/log; it may end with the exit code OTHER_EXIT.
seconds_of() {
  (
    "$@" >"$work/log" 2>"$work/errors" || [ $? = "${OTHER_EXIT:-0}" ] || { cat "$work/log" "$work/errors" >&2; exit 1; }
    times >"$work/times"
  )
  awk 'NR == 2 { for (i = 1; i <= 2; ++i) { split($i, t, /[ms]/); s += 60 * t[1] + t[2] } printf "%.2f", s }' "$work/times"
}
# Blender on one thread, by a script of this folder.
blender_seconds() { # SCRIPT ARGUMENTS …
  script=$1
  shift
  seconds_of blender -b --factory-startup -t 1 --python-exit-code 1 -P "bench/peers/$script" -- "$@"
}
row() { echo "$1" | tee -a "$work/new.csv"; }
# The mesh as both programs take it.
refine() { # FILE REFINEMENTS OUTPUT
  if [ "$2" -gt 0 ]; then
    "$bin/furrow" subdivide "$1" --subdivide "$2" -o "$3" --quiet --replace
  else
    cp "$1" "$3"
  fi
}
