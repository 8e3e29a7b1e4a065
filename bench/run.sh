#!/bin/bash
# Runs the benchmark programs one after another and draws the chart. Called by the target carom_bench (./carom bench).
#   run.sh PROGRAMS RESULTS [rows|figures]   folders of the programs and for the results; both parts if none is named
# On a shared machine, as root, CAROM_BENCH_SHIELD=1 ./carom bench stops other programs during measurements.
set -euo pipefail
programs=$1
results=$2
part=${3-all}
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
CAROM_COMMIT=$(git -C "$here" describe --always --dirty 2>/dev/null || true)
export CAROM_COMMIT
mkdir -p "$results"

if [[ $part != figures ]]; then
    for rows in phases step exact; do
        "$programs/bench_$rows" --benchmark_enable_random_interleaving=true --benchmark_repetitions=3 \
            --benchmark_display_aggregates_only=true --benchmark_counters_tabular=true \
            --benchmark_out="$results/rows_$rows.csv" --benchmark_out_format=csv
    done
fi
if [[ $part != rows ]]; then
    "$programs/carom_figures" "$results"
    (cd "$results" && gnuplot "$here/scaling.gp")
fi
