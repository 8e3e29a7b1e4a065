#!/bin/bash
# The cost of ranks on this machine, compared with a model of its parts (docs/scaling.md). Called by ./carom bench
# ranks; nothing else should run meanwhile.
#   ranks.sh PROGRAM SCENES FILE      the scene is SCENES/gas_million.toml; writes the CSV file
# Seconds of stepping, in turns, the best of three rounds: one process with one thread and with one thread for each
# core, and 2 and 4 ranks of one thread. The model uses only the first two, a small system, and counts:
#   seconds = (one process with a thread for each core) * (1 + ghosts / disks of a rank) + waits * (time of one)
# ghosts: those whose events a rank processes, too (exact); a wait: for the two neighbours, or for all ranks.
set -euo pipefail
program=$(readlink -f -- "$1") scene=$(readlink -f -- "$2")/gas_million.toml file=$(readlink -f -- "$3")
cores=$(nproc)
rounds=3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# KEY in the run's summary; the last number of its value.
value() { # FILE KEY
    awk -v key="\"$2\"" '
        index($0, key) { found = 1 }
        found && /[0-9]/ { n = $0; sub(/.*: */, "", n); gsub(/[^0-9.e+-]/, "", n); if (n != "") { print n; exit } }' "$1"
}
# For one of the three parts of "traffic": its number in each step.
waits() { # FILE
    awk '
        /"traffic"/ { inside = 1 }
        inside && /"messages"/ { gsub(/[^0-9.]/, ""); messages[++parts] = $0 }
        END { print messages[1] / 2 + messages[2] }' "$1"
}
ghosts_a_disk() { # FILE
    awk '
        /"traffic"/ { inside = 1 }
        inside && /"disks"/ { into = "disks" }
        inside && /"ghosts"/ { into = "ghosts" }
        /\]/ { into = "" }
        into != "" && /^ *[0-9]+,?$/ { gsub(/[^0-9]/, ""); if ($0 > most[into]) most[into] = $0 }
        END { print most["disks"] ? most["ghosts"] / most["disks"] : 0 }' "$1"
}

run() { # NAME ARGUMENTS
    local name=$1
    shift
    "$program" run "$@" --json --quiet --force -o "$name.out" >"$name.json" 2>"$name.log" || {
        cat "$name.log" >&2
        return 1
    }
    local step_s best
    step_s=$(value "$name.json" step_s)
    best=$(cat "$name.best" 2>/dev/null || echo "$step_s")
    awk -v a="$step_s" -v b="$best" 'BEGIN { print (a < b) ? a : b }' >"$name.best"
}

small=(--set 'disks.0.count=4000' --set 'disks.0.positions="square"')
length() { [[ $1 == pairwise ]] && echo 0.5 || echo 1.5; }
for ((round = 0; round < rounds; ++round)); do
    for method in pairwise exact; do
        common=("$scene" --method "$method" --t-end "$(length "$method")")
        run "$method.threads1" "${common[@]}" --threads 1
        run "$method.threads" "${common[@]}" --threads "$cores"
        for ranks in 2 4; do run "$method.$ranks" "${common[@]}" --threads 1 --ranks "$ranks"; done
    done
    run wait.1 "$scene" --method pairwise --t-end 20 "${small[@]}" --threads 1
    run wait.2 "$scene" --method pairwise --t-end 20 "${small[@]}" --threads 1 --ranks 2
done

one_wait=$(awk -v one="$(<wait.1.best)" -v two="$(<wait.2.best)" -v steps="$(value wait.2.json steps)" -v n="$(waits wait.2.json)" \
    'BEGIN { print (two - one / 2) / (steps * n) }')
{
    echo "method,ranks,cores,measured_s,model_s,steps,ghosts_a_disk,waits_a_step,one_wait_s,one_thread_s,thread_a_core_s"
    for method in pairwise exact; do
        for ranks in 2 4; do
            json=$method.$ranks.json
            awk -v OFS=, -v method="$method" -v ranks="$ranks" -v cores="$cores" -v measured="$(<"$method.$ranks.best")" \
                -v one="$(<"$method.threads1.best")" -v all="$(<"$method.threads.best")" -v steps="$(value "$json" steps)" \
                -v ghosts="$(ghosts_a_disk "$json")" -v waits="$(waits "$json")" -v wait="$one_wait" 'BEGIN {
                    print method, ranks, cores, measured, all * (1 + ghosts) + steps * waits * wait * ((ranks > cores) ? ranks / cores : 1),
                        steps, ghosts, waits, wait, one, all }'
        done
    done
} >ranks.csv
column -s, -t <ranks.csv
cp ranks.csv "$file"
