#!/usr/bin/env bash
# Installs what is missing, builds with warnings as errors, checks format and clang-tidy on what changed, and
# runs every test. Ends with ctest's summary.
#   tests/run.sh [CTEST OPTIONS]     e.g. tests/run.sh -R Segmenter
set -euo pipefail
source "$(dirname "$0")/../modules/usage.sh"
help_if_asked "$@"
# ctest would pass over what it does not know, and run all tests at the end of the build. On a new computer it is not
# there yet.
known=$(command -v ctest > /dev/null && ctest --help | grep -oE '(^|[ ,])--?[A-Za-z][A-Za-z-]*' | tr -d ' ,' || true)
case ${1:--} in -*) ;; *) wrong_usage "$1: is no option of ctest" ;; esac
for word in "$@"; do
  case $word in -j[0-9]*) continue ;; -*) ;; *) continue ;; esac
  [ -z "$known" ] || grep -qxF -e "${word%%=*}" <<< "$known" || wrong_usage "$word: is no option of ctest"
done
cd "$(dirname "$0")/.."

step() { printf '\n== %s\n' "$*"; }

step "dependencies"
modules/install_dependencies.sh test

step "format"
sources=$(git ls-files '*.cpp' '*.hpp')
[ -z "$sources" ] || echo "$sources" | xargs clang-format --dry-run --Werror
echo "$(echo "$sources" | wc -l) files are formatted"

step "build, warnings are errors"
cmake --preset ci
cmake --build --preset ci

step "clang-tidy on changed files"
# Only what the build compiles (lcmtypes/examples are built against the packages). Changed: against the commit that
# LIMBCAST_TIDY_BASE names, or else by the last commit and the work tree.
base=${LIMBCAST_TIDY_BASE:-$(git rev-parse --verify -q HEAD~1 || git rev-parse HEAD)}
changed=$(git diff --name-only --diff-filter=d "$base" -- 'common/*.cpp' 'modules/*.cpp' 'tests/*.cpp' | sort -u)
if [ -n "$changed" ]; then
  echo "$changed"
  # The build takes several files at a time; clang-tidy needs to know how each is compiled alone.
  cmake --preset tidy > build/tidy.log || { cat build/tidy.log; exit 1; }
  cmake --build build/tidy --target limbcast_lcmtypes_headers > build/tidy.log || { cat build/tidy.log; exit 1; }
  echo "$changed" | xargs -P "$(nproc)" -n 1 clang-tidy -p build/tidy --quiet
else
  echo "no source file changed"
fi

step "tests"
# One more than there are processors: live robots and cameras mostly wait.
ctest --preset ci -j "$(($(nproc) + 1))" "$@"
