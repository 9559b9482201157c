#!/bin/bash
# limit_mechanisms.sh OUT RUN ...: draws the mechanisms of limits of acceleration and lantern side by side. A script, not a table of
# a study: it joins pictures.
out=$1; shift
names=(); files=
for limit in lateral lantern; do
  for name; do
    case $name in *_"$limit"_limit) ;; *) continue ;; esac
    file=$out/$name/post/pictures/motion.png
    if [ -f "$file" ]; then names+=("$name"); files="$files $file"; fi
  done
done
gnuplot -e "files='$files'; titles='${names[*]}'; picture='docs/pictures/limit_mechanisms.png'" tests/benchmark/limit_mechanisms.gp
