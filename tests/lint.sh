#!/bin/bash
# Runs clang-tidy (.clang-tidy) and cppcheck on the sources of the project; the exit code is 0 if neither reports anything.
#
#   lint.sh BUILD_FOLDER [JOBS, default 1]
set -u
build=$(realpath "$1"); jobs=${2:-1}
cd "$(dirname "$0")/.." || exit 1
failed=0
git ls-files 'assembly/*.cpp' 'generators/*.cpp' 'solver/*.cpp' 'postproc/*.cpp' |
  xargs -P "$jobs" -n 4 clang-tidy -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option 2> /dev/null || failed=1
# cppcheck does not parse the headers of the libraries. Reasons for the suppressions:
#   missingInclude, missingIncludeSystem, unknownMacro: headers of the libraries are not parsed
#   unmatchedSuppression: inline suppressions are meant for clang-tidy
cppcheck --language=c++ --std=c++20 --enable=warning,performance,portability --inline-suppr --error-exitcode=1 -j "$jobs" \
  --suppress=missingInclude --suppress=missingIncludeSystem --suppress=unknownMacro --suppress=unmatchedSuppression \
  -I . --quiet assembly generators solver postproc || failed=1
exit $failed
