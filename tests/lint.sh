#!/bin/bash
# clang-tidy (.clang-tidy) and cppcheck over the project's own sources; ends with 0 when neither says anything.
#
#   lint.sh BUILD_FOLDER [JOBS, default 1]
set -u
build=$(realpath "$1"); jobs=${2:-1}
cd "$(dirname "$0")/.." || exit 1
failed=0
git ls-files 'assembly/*.cpp' 'generators/*.cpp' 'solver/*.cpp' 'postproc/*.cpp' |
  xargs -P "$jobs" -n 4 clang-tidy -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option 2> /dev/null || failed=1
# cppcheck sees the sources without the libraries' headers; each exception says why.
#   missingInclude, unknownMacro: the libraries' headers are not parsed
#   useStlAlgorithm: a loop that reads as the formula does stays a loop
#   unmatchedSuppression: inline suppressions hold for clang-tidy
cppcheck --language=c++ --std=c++20 --enable=warning,performance,portability --inline-suppr --error-exitcode=1 -j "$jobs" \
  --suppress=missingInclude --suppress=missingIncludeSystem --suppress=unknownMacro --suppress=unmatchedSuppression \
  -I . --quiet assembly generators solver postproc || failed=1
exit $failed
