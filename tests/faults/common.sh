# For the scripts of this folder: the three programs on a small case, and what they leave. Expects $bin, makes $work.
# They say little; `quiet= solve ...` says all.
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
work=$(mktemp -d); trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
case_file=$work/small.yaml; cp "$here/small.yaml" "$case_file"

generate() { "$bin/cupola-generate" "$case_file" --quiet --output "$1/assembly.vtu" "${@:2}"; }
solve() { "$bin/cupola-solve" "$case_file" ${quiet---quiet} --assembly "$1/assembly.vtu" --output "$1/results" "${@:2}"; }
post() { "$bin/cupola-post" analyse "$case_file" --quiet --assembly "$1/assembly.vtu" --results "$1/results" --output "$1/post" "${@:2}"; }

# One line per file: name and checksum, without wall times and memory, which no two runs share.
# contents FOLDER [MORE LINES TO LEAVE OUT]
contents() {
  local times="_time_seconds|solve_time|peak[_ ]memory${2:+|$2}" all file
  (cd "$1" && all=$(find . -type f ! -name '*.part*' ! -name '.*' | sort) && [ -n "$all" ] || return 0
    { for file in $(grep -laE "$times" $all); do echo "$(sed -E "/$times/d" "$file" | md5sum) $file"; done
      grep -LaE "$times" $all | xargs -r md5sum; } | awk '{print $NF, $1}' | sort)
}
