#!/usr/bin/env bash
# Measures the small benchmark bench.json and holds it against kept.json: the quality of every technique with its defaults
# must be the same, and its time, as a multiple of a view of accumulation in the same run, at most a few times the kept one
# (machines differ, and other tests run beside this one). With LENSGRAPH_UPDATE_GOLDEN=1 the result is kept instead.
#
# usage: compare_with_kept.sh PROGRAM FOLDER (of bench.json and kept.json)
# Exit status: 0 all is well, 1 a regression, 77 nothing was compared: kept.json is of another device, or was written.
set -euo pipefail
program=$1
folder=$2
nothing_compared=77

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$program" bench "$folder/bench.json" -o "$scratch/now"

if [[ ${LENSGRAPH_UPDATE_GOLDEN:-} == 1 ]]; then
  cp "$scratch/now/bench.json" "$folder/kept.json"
  echo "kept: $folder/kept.json"
  exit $nothing_compared
fi

status=0
"$program" compare-bench "$folder/kept.json" "$scratch/now" --complete --unit accumulationView --time-tolerance 3 \
  --psnr-tolerance .001 --ssim-tolerance .00001 2> "$scratch/errors" || status=$?
cat "$scratch/errors" >&2
if ((status == 2)) && grep -qE ': device\.(name|driver): ' "$scratch/errors"; then exit $nothing_compared; fi
exit "$status"
