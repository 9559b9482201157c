#!/bin/bash
# Makes the Debian package, installs it below a scratch root, and uses it as a user does: in an empty folder, with no
# other part of the repository.
#
#   install_test.sh BUILD_FOLDER
set -eu
build=$1
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $1" >&2; exit 1; }

# The umask of who makes the package does not matter.
(umask 077; cd "$build" && cpack -G DEB -B "$work/package" > "$work/cpack.log" 2>&1) || { cat "$work/cpack.log"; fail "cpack"; }
package=$(ls "$work"/package/*.deb)
dpkg-deb --contents "$package" | awk '{print $1, $6}' > "$work/rights"
! grep -vE '^(-rw-r--r--|[-d]rwxr-xr-x) ' "$work/rights" || fail "a file or folder of the package has other rights"
dpkg-deb --field "$package" Depends | grep -q libvtk || fail "the package does not depend on its libraries"

# dpkg itself installs it, into a root with an empty database; the libraries are those of this machine.
root=$work/root
mkdir -p "$root/var/lib/dpkg/info" "$root/var/lib/dpkg/updates"; touch "$root/var/lib/dpkg/status"
dpkg --root="$root" --force-depends --force-not-root --log=/dev/null -i "$package" > "$work/dpkg.log" 2>&1 \
  || { cat "$work/dpkg.log"; fail "dpkg"; }
cupola=$root/usr/bin/cupola

mkdir "$work/user"; cd "$work/user"
unset CUPOLA_CASES
cat > my_wall.yaml <<END
extends: cupola:wall_small
geometry: {bond: {rings: 4, blocks_per_ring: 3}}
END
"$cupola" run my_wall.yaml > run.log 2>&1 || { cat run.log; fail "cupola run"; }
[ -s out/my_wall/post/report.html ] || fail "no report"
"$cupola" run my_wall.yaml > again.log 2>&1 || fail "second run"
! grep -q cupola-solve again.log || { cat again.log; fail "a second run solves again"; }
echo "joints: {friction: 0.5}" >> my_wall.yaml
"$cupola" run my_wall.yaml > changed.log 2>&1 || fail "changed case"
grep -q cupola-solve changed.log || fail "a changed case is not solved again"

# Warnings are errors with --strict, also for a run that is up to date.
"$cupola" run my_wall.yaml --strict > strict.log 2>&1 || { cat strict.log; fail "strict run of a sound case"; }
printf 'extends: cupola:wall_small\ngeometry: {bond: {rings: 4, blocks_per_ring: 3}}\nmaterial: {density: 18}\n' > light_wall.yaml
"$cupola" run light_wall.yaml > light.log 2>&1 || { cat light.log; fail "a warning stops a run"; }
[ "$(grep -c 'warning: material.unit_weight = 176.58 N/m3' light.log)" = 1 ] || { cat light.log; fail "the warning is not printed once"; }
"$cupola" run light_wall.yaml --strict > strict.log 2>&1 && { cat strict.log; fail "--strict accepts a warning"; }
grep -q 'error: --strict' strict.log || { cat strict.log; fail "--strict fails for another reason"; }
"$cupola" run light_wall.yaml > light.log 2>&1 || { cat light.log; fail "run without --strict again"; }

# A bundled case that names a file of its own, and mistakes.
echo "extends: cupola:portal" > my_portal.yaml
"$root/usr/bin/cupola-generate" my_portal.yaml --inputs | grep -q share/cupola/cases/portal.obj || fail "file of a bundled case"
echo "extends: cupola:dome_circlar" > typo.yaml
"$root/usr/bin/cupola-generate" typo.yaml --check 2>&1 | grep -q "did you mean cupola:dome_circular" || fail "name of a bundled case"
echo "extends: cupola:../../../../etc/passwd" > outside.yaml
"$root/usr/bin/cupola-generate" outside.yaml --check 2>&1 | grep -q "no bundled case has this name" || fail "path out of the folder"
"$cupola" run my_wal.yaml 2>&1 | grep -q "did you mean my_wall" || fail "nearest case"
"$cupola" run my_wall 2>&1 | grep -q "give the file of the case: my_wall.yaml" || fail "case without .yaml"
"$cupola" cases | grep -q dome_circular || fail "list of cases"
"$cupola" cases | grep -q claims && fail "claims are no cases"
cp my_wall.yaml second_wall.yaml
"$cupola" run my_wall.yaml second_wall.yaml > two.log 2>&1 || { cat two.log; fail "two cases"; }
cp my_wall.yaml third_wall.yaml; echo "joints: {frction: 0.5}" > bad.yaml
"$cupola" run bad.yaml third_wall.yaml > bad.log 2>&1 && { cat bad.log; fail "a bad case is no failure"; }
[ -s out/third_wall/post/report.html ] || { cat bad.log; fail "a bad case stops the next one"; }

dpkg --root="$root" --force-not-root --log=/dev/null -r cupola > "$work/dpkg.log" 2>&1 || { cat "$work/dpkg.log"; fail "removal"; }
[ ! -e "$cupola" ] || fail "files remain after removal"
echo "$(basename "$package"): installed, used and removed"
