#!/bin/sh
# Runs ParaView's pvbatch without a display:  tests/postproc/pvbatch.sh SCRIPT.py
#
# Debian's ParaView requires an X display: this script runs it on a virtual one. A lock lets only one run at a time,
# because parallel runs crash.
set -eu
lock=${XDG_CACHE_HOME:-$HOME/.cache}/cupola
mkdir -p "$lock"
exec 9>"$lock/lock"
flock 9
. "$(dirname "$0")/../../postproc/pictures/python_module.sh"
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
