#!/bin/bash
# Counts instructions, cache misses and mispredicted branches of fixed scenes with cachegrind: the counts do not depend
# on how busy the machine is. Called by ./carom bench counts. The start-up of the program does not count: each scene
# runs for two lengths, and the difference of the counts over the difference of the work is written.
#   counts.sh PROGRAM FILE            writes the CSV file
#   counts.sh PROGRAM FILE --check    fails, with a line for each, if a count is above the file's by more than 3 %
#                                   (mispredictions: 15 %, and 4 % in the mean of all scenes) and by 0.001 per event
#   counts.sh PROGRAM FILE --features   the same for scene G with one feature each, for docs/benchmarks.md
set -euo pipefail
file=$(readlink -f -- "$2")
mode=${3-}
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
[[ ! $mode || $mode == --check || $mode == --features ]] || { echo "usage: ./carom bench counts [--check | --features]" >&2 && exit 2; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# The program has the same name wherever it is: the length of the command line shifts the stack.
ln -s "$(readlink -f -- "$1")" "$scratch/carom_counts"
cd "$scratch"

# The events counted, in the order of per_work.
columns=(instructions first_level_misses last_level_misses mispredicted_branches)

prepare() { # SCENE
    ./carom_counts prepare "$1" "$1.start"
}

# Runs without the caller's environment, for the same reason. The caches simulated are those of a common core, whatever
# this machine has.
count() { # SCENE.LENGTH
    local scene=${1%.*} length=${1##*.}
    env -i valgrind --tool=cachegrind --cache-sim=yes --branch-sim=yes --I1=32768,8,64 --D1=49152,12,64 --LL=1048576,16,64 \
        --cachegrind-out-file="$1.counts" --log-file="$1.log" \
        ./carom_counts run "$scene" "$scene.start" "$length" >"$1.work" || {
        cat "$1.log" >&2
        return 1
    }
}
export -f prepare count

# "name value" of every event, and of the work done.
totals() { # SCENE.LENGTH
    awk -v work="$(<"$1.work")" '
        /^events:/ { for (k = 2; k <= NF; ++k) name[k] = $k }
        /^summary:/ { for (k = 2; k <= NF; ++k) print name[k], $k }
        END { print "work", work }' "$1.counts"
}

# The columns of a scene, separated by commas.
per_work() { # SCENE
    join <(totals "$1.long" | sort) <(totals "$1.short" | sort) | awk '
        { grown[$1] = $2 - $3 }
        END {
            printf "%.5g,%.4g,%.4g,%.4g", grown["Ir"] / grown["work"],
                (grown["I1mr"] + grown["D1mr"] + grown["D1mw"]) / grown["work"],
                (grown["ILmr"] + grown["DLmr"] + grown["DLmw"]) / grown["work"],
                (grown["Bcm"] + grown["Bim"]) / grown["work"]
        }'
}

table() {
    local commit compiler scene disks work
    compiler=$(./carom_counts compiler)
    commit=$(git -C "$here" describe --always --dirty 2>/dev/null || true)
    printf 'scene,disks,per'
    printf ',%s' "${columns[@]}" compiler commit
    echo
    while read -r scene disks work; do
        echo "$scene,$disks,$work,$(per_work "$scene"),$compiler,$commit"
    done <scenes.txt
}

./carom_counts scenes "${mode#--}" >scenes.txt
cut -d' ' -f1 scenes.txt | tac | xargs -P "$(nproc)" -I% bash -c 'prepare %'
cut -d' ' -f1 scenes.txt | sed 's/.*/&.long\n&.short/' | sort -t. -k2 | xargs -P "$(nproc)" -I% bash -c 'count %'
table >counts.csv
column -s, -t <counts.csv

if [[ $mode != --check ]]; then
    cp counts.csv "$file"
    exit
fi
# Columns 4 to 7 are the counts. A scene that is not in the file is not checked. Cachegrind's table of branches is
# indexed by the last 7 bits of an address and the last 7 branches: when code merely moved to other addresses (the same
# instructions, the same branches), mispredictions of a scene have changed by up to 17 %. Such random changes average
# out over the scenes, so the mean of all has a much closer limit.
# Counts below a thousandth of an event are a few dozen in the whole run, which depend on the addresses of memory: their
# relative change means nothing.
awk -F, '
    FNR == 1 { for (k = 4; k <= 7; ++k) { name[k] = $k; gsub("_", " ", name[k]) } next }
    FNR == NR { compiler = $8; for (k = 4; k <= 7; ++k) kept[$1, k] = $k; next }
    FNR == 2 && $8 != compiler { print "counts: the file is of another compiler, " compiler }
    !(($1, 4) in kept) { print "counts: " $1 " is not in the file: ./carom bench counts"; bad = 1; next }
    {
        for (k = 4; k <= 7; ++k) {
            if ($k <= (k == 7 ? 1.15 : 1.03) * kept[$1, k] + 0.001) continue
            printf "counts: %s: %s %s per %s, %s in the file (%+.1f %%)\n", $1, $k, name[k], $3, kept[$1, k], 100 * ($k / kept[$1, k] - 1)
            bad = 1
        }
        if ($7 > 0 && kept[$1, 7] > 0) { growth += log($7 / kept[$1, 7]); ++scenes }
    }
    END {
        if (scenes && growth / scenes > log(1.04)) {
            printf "counts: %s of all scenes: %+.1f %% in the mean\n", name[7], 100 * (exp(growth / scenes) - 1)
            bad = 1
        }
        exit bad
    }' "$file" counts.csv
