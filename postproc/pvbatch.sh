#!/bin/sh
# Runs ParaView's pvbatch without a display:  postproc/pvbatch.sh views.py
#
# Debian's ParaView draws through X only, and its Python module comes in a package that cannot be installed
# beside VTK's headers. This script unpacks that module into a cache of its own and lends pvbatch a virtual
# display. One picture run at a time: parallel virtual displays crash.
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
# The virtual display now and then fails to start on a busy machine: a second try is worth it.
xvfb-run -a pvbatch "$@" 9>&- || { sleep 2; xvfb-run -a pvbatch "$@" 9>&-; }
