# Sourced: finds the Python module of ParaView. On Debian 12 its package, python3-paraview, cannot be installed beside the
# VTK headers (libvtk9-dev), so it is downloaded and unpacked into a cache.
cache=${XDG_CACHE_HOME:-$HOME/.cache}/cupola
modules=$cache/python3-paraview/usr/lib/python3/dist-packages
mkdir -p "$cache"
if [ ! -d "$modules/paraview" ] && ! python3 -c 'import paraview' 2>/dev/null; then
  (cd "$cache" && apt-get download python3-paraview && dpkg-deb -x python3-paraview_*.deb python3-paraview)
fi
if [ -d "$modules/paraview" ]; then PYTHONPATH=$modules${PYTHONPATH:+:$PYTHONPATH}; export PYTHONPATH; fi
