#!/bin/bash
# Makes the manual page from the program's --help: man_page.sh CAROM VERSION
set -euo pipefail
carom=$1

# The text of --help as it is, with characters escaped that are special to troff.
verbatim() { sed 's/\\/\\e/g; s/^\([.'"'"']\)/\\\&\1/; s/-/\\-/g'; }

# The commands that --help lists.
commands() { "$carom" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p'; }

cat <<EOP
.TH CAROM 1 "" "Carom $2" "User Commands"
.SH NAME
carom \- hard disks in a rectangle, simulated exactly and fast
.SH SYNOPSIS
.B carom
.I command
[\fIoptions\fR]
.SH DESCRIPTION
Carom simulates disks that fly, fall and bounce off each other inside a rectangle, from a scene in a short text file. The
same scene gives the same result every time, to the last bit, on any number of threads.
.SH COMMANDS
EOP
for command in $(commands); do
    printf '.SS carom %s\n.nf\n' "$command"
    "$carom" "$command" --help | verbatim
    printf '.fi\n'
done
cat <<'EOP'
.SH EXIT STATUS
0: done; 1: failed while running, or, of compare, different; 2: bad usage or a bad scene, with the file, the line, the key
and what was expected; 3: a check of the physics failed; 4: stopped early, with a checkpoint unless the initial state was
still being made.
.SH ENVIRONMENT
.B CAROM_KERNELS=baseline
takes the instructions that every processor has; the bits are the same.
.B USER
is the author that trajectory.h5 names.
EOP
