#!/bin/sh
# Runs ParaView's pvbatch without a display:  postproc/pictures/pvbatch.sh views.py
#
# Debian's ParaView requires an X display, and the package of its Python module conflicts with the VTK
# headers. This script unpacks the module into a cache and runs pvbatch on a virtual display. A lock lets only
# one run at a time, because parallel runs crash.
set -eu
cache=${XDG_CACHE_HOME:-$HOME/.cache}/cupola
modules=$cache/python3-paraview/usr/lib/python3/dist-packages
mkdir -p "$cache"
exec 9>"$cache/lock"
flock 9
if [ ! -d "$modules/paraview" ] && ! python3 -c 'import paraview' 2>/dev/null; then
  (cd "$cache" && apt-get download python3-paraview && dpkg-deb -x python3-paraview_*.deb python3-paraview)
fi
if [ -d "$modules/paraview" ]; then PYTHONPATH=$modules${PYTHONPATH:+:$PYTHONPATH}; export PYTHONPATH; fi
if [ -n "${DISPLAY:-}" ]; then exec pvbatch "$@"; fi

# The display number depends on the process id, so that it is free. The server is ready when its socket
# exists. Without -noreset it would restart whenever a client leaves and refuse the next one meanwhile.
number=$((1000 + $$ % 30000))
Xvfb :$number -screen 0 1280x1024x24 -nolisten tcp -noreset >/dev/null 2>&1 9>&- &
server=$!
trap 'kill "$server" 2>/dev/null || true' EXIT
for _ in $(seq 600); do
  if [ -S "/tmp/.X11-unix/X$number" ]; then break; fi
  sleep 0.1
done
DISPLAY=:$number pvbatch "$@" 9>&-
