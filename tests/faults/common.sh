# Shared by the scripts of this folder: runs the three programs on a small case and lists their output. Expects $bin,
# creates $work. The programs run with --quiet; `quiet= solve ...` prints everything.
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
work=$(mktemp -d); trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
case_file=$work/small.yaml; cp "$here/small.yaml" "$case_file"
# write_case ANALYSIS: the small case, with another analysis than its motion.
analyses="dynamic static range limit staged path"
write_case() {
  local line
  case $1 in
    dynamic) line=$(grep ^analysis: "$here/small.yaml") ;;
    static) line="analysis: {type: static}" ;;
    range) line="analysis: {type: range, range: {quantities: [{type: joint, blocks: [0, 1], component: normal}]}}" ;;
    limit) line="analysis: {type: limit, limit: {parameter: acceleration}}" ;;
    staged) line="analysis: {type: staged, friction_law: coulomb, staged: {carry: true}}" ;;
    path) line=$'loads: {dead_load_time: {type: ramp, from: 0.5}}\nanalysis: {type: path, path: {steps: 5, control: {block: 1}}}' ;;
  esac
  { grep -v ^analysis: "$here/small.yaml"; echo "$line"; } > "$case_file"
}
generate() { "$bin/cupola-generate" "$case_file" --quiet --output "$1/assembly.vtu" "${@:2}"; }
solve() { "$bin/cupola-solve" "$case_file" ${quiet---quiet} --assembly "$1/assembly.vtu" --output "$1/results" "${@:2}"; }
post() { "$bin/cupola-post" analyse "$case_file" --quiet --assembly "$1/assembly.vtu" --results "$1/results" --output "$1/post" "${@:2}"; }

# contents FOLDER [PATTERN]: one line per file with name and checksum, ignoring lines with times and memory, which
# differ between runs, and lines that match PATTERN.
contents() {
  local times="_time_seconds|solve_time|peak[_ ]memory${2:+|$2}" all file
  (cd "$1" && all=$(find . -type f ! -name '*.part*' ! -name '.*' | sort) && [ -n "$all" ] || return 0
    { for file in $(grep -laE "$times" $all); do echo "$(sed -E "/$times/d" "$file" | md5sum) $file"; done
      grep -LaE "$times" $all | xargs -r md5sum; } | awk '{print $NF, $1}' | sort)
}
