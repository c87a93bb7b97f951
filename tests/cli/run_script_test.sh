#!/usr/bin/env bash
# What ./run says and leaves behind when its steps are interrupted or cannot write; cmake and dpkg-query are stand-ins.
# run_script_test.sh SOURCE_FOLDER
set -euo pipefail
run=$1/run
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir programs
printf '#!/bin/sh\necho ii\n' >programs/dpkg-query
# Configures, or builds, until it is ended; then says so.
cat >programs/cmake <<'CMAKE'
#!/usr/bin/env bash
trap 'touch "$FOLDER/ended"; kill %1; exit 1' TERM
touch "$FOLDER/started"
sleep 30 &
wait
CMAKE
chmod +x programs/*
export PATH=$folder/programs:$PATH FOLDER=$folder LENSGRAPH_BUILD_DIR=below/build

fail() { printf 'failed: %s\n' "$*"; cat output; exit 1; }

# interrupt SIGNAL STATUS WHAT: the signal reaches the script alone.
interrupt() {
  rm -f started ended
  (trap - INT; exec "$run" build) >output 2>&1 &
  local script=$! status=0
  for _ in {1..200}; do [[ ! -e started ]] || break; sleep 0.05; done
  kill -s "$1" "$script"
  wait "$script" || status=$?
  [[ $status == "$2" ]] || fail "$1 while $3 ended with status $status"
  [[ -e ended ]] || fail "$1 while $3 left the step running"
  [[ $(tail -n 1 output) == "run: interrupted while $3; the same command goes on from there" ]] || fail "$1 while $3"
}

mkdir -p below/build/debian/usr/share/nodejs/{d3,dagre}/dist
touch below/build/debian/usr/share/nodejs/{d3/dist/d3,dagre/dist/dagre}.min.js
interrupt TERM 143 configuring
[[ ! -e below/build/build.ninja ]] || fail "an interrupted configuration counts as one"
touch below/build/build.ninja below/build/CMakeCache.txt
interrupt TERM 143 building

if LENSGRAPH_BUILD_DIR=programs/cmake/build "$run" build >output 2>&1; then fail "built below a file"; fi
expected="run: cannot write to $folder/programs/cmake/build; LENSGRAPH_BUILD_DIR=FOLDER chooses another"
[[ $(cat output) == "$expected" ]] || fail "another message"
