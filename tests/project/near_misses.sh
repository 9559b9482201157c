#!/bin/bash
# Names that are nearly right: make says what was probably meant. Cases in a user's folder are found there.
#
#   near_misses.sh REPOSITORY
set -u
makefile=$1/Makefile.cases
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
echo 'extends: cupola:dome_circular' > my_dome.yaml

failed=0
# expect GOAL PHRASE: make refuses the goal with the phrase.
expect() {
  text=$(make -n -f "$makefile" FOLDER=. "$1" 2>&1) && { echo "$1: make accepts it"; failed=1; }
  case $text in *"$2"*) ;; *) echo "$1: expected '$2', got: $text"; failed=1 ;; esac
}
expect my_dom "my_dom: no case in . and no target has this name; did you mean my_dome"
expect hlep "did you mean help"
expect my_dome.yaml "my_dome.yaml: give the name of the case, not its file: my_dome"
expect ./my_dom.yaml "give the name of the case, not its file: my_dome"
expect something_else "something_else: no case in . and no target has this name."
# Several goals.
cp my_dome.yaml other_dome.yaml
for goals in "my_dome other_dome" "help packages"; do
  make -n -f "$makefile" FOLDER=. $goals > out.txt 2>&1 || { echo "$goals:"; cat out.txt; failed=1; }
done
make -n -f "$makefile" FOLDER=. my_dome > out.txt 2>&1 || { cat out.txt; failed=1; }
grep -q 'cupola-generate ./my_dome.yaml --output out/my_dome/assembly.vtu' out.txt || { echo "my_dome: not run here"; failed=1; }
exit $failed
