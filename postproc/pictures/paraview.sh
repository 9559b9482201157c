#!/bin/sh
# Opens a run in ParaView:  postproc/pictures/paraview.sh out/NAME/post
#
# A ParaView with Python of its own needs only, in the folder out/NAME/post: paraview --script=open_in_paraview.py
set -eu
post=$(cd "$1" && pwd)
[ -f "$post/open_in_paraview.py" ] || { echo "$1: no open_in_paraview.py; give the folder post of a run" >&2; exit 2; }
. "$(dirname "$0")/python_module.sh"
# With --dr no welcome window waits to be closed before the script runs.
export CUPOLA_POST="$post"
exec paraview --dr --script="$post/open_in_paraview.py"
