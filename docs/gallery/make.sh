#!/bin/bash
# Makes the pages of the gallery again: runs each scene of README.md in this folder and makes a page of it, of at most
# half a megabyte. Takes about a minute.
#   docs/gallery/make.sh
set -euo pipefail
cd -- "$(dirname -- "$(readlink -f -- "$0")")"
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

page() { # SCENE, then options of carom run
    ../../carom run "../../scenes/$1.toml" -o "$work/$1" --quiet --set 'output.trajectory="h5md"' "${@:2}"
    ../../carom view "$work/$1" -o "$1.html" --max-size 500kB --force
}

page analysis --t-end 6 --set output.every=0.1
page brownian_sink
page dense_mixture --t-end 4 --set output.every=0.02
page galton_board --t-end 40
page mixing --t-end 60 --set output.every=0.5
page shaken_bed --t-end 10 --set output.every=0.02
