# Shared by the scripts of this folder: runs the three programs on a small case and lists their output. Expects $bin,
# creates $work. The programs run with --quiet; `quiet= solve ...` prints everything. `settings` changes keys of the case.
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
work=$(mktemp -d); trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
case_file=$work/small.yaml; cp "$here/small.yaml" "$case_file"
settings=

# Every analysis on the small case, by the keys that it changes. A motion is what the case asks for.
analyses="dynamic static range limit staged path"
settings_of() {
  case $1 in
    dynamic) ;;
    static) echo --set analysis.type=static ;;
    range) echo --set analysis.type=range --set analysis.range.quantities=[{type:reaction,block:1}] ;;
    limit) echo --set analysis.type=limit --set analysis.limit.parameter=acceleration ;;
    staged) echo --set analysis.type=staged --set analysis.staged.carry=true --set analysis.friction_law=coulomb ;;
    path) echo --set analysis.type=path --set analysis.path.steps=5 --set analysis.path.control.block=1 ;;
  esac
}
generate() { "$bin/cupola-generate" "$case_file" --quiet --output "$1/assembly.vtu" $settings "${@:2}"; }
solve() { "$bin/cupola-solve" "$case_file" ${quiet---quiet} --assembly "$1/assembly.vtu" --output "$1/results" $settings "${@:2}"; }
post() { "$bin/cupola-post" analyse "$case_file" --quiet --assembly "$1/assembly.vtu" --results "$1/results" --output "$1/post" $settings "${@:2}"; }

# contents FOLDER [PATTERN]: one line per file with name and checksum, ignoring lines with times and memory, which
# differ between runs, and lines that match PATTERN.
contents() {
  local times="_time_seconds|solve_time|peak[_ ]memory${2:+|$2}" all file
  (cd "$1" && all=$(find . -type f ! -name '*.part*' ! -name '.*' | sort) && [ -n "$all" ] || return 0
    { for file in $(grep -laE "$times" $all); do echo "$(sed -E "/$times/d" "$file" | md5sum) $file"; done
      grep -LaE "$times" $all | xargs -r md5sum; } | awk '{print $NF, $1}' | sort)
}
