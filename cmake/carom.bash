# Completion of carom for bash: commands, the options that --help of a command lists, files.
_carom() {
    local word=${COMP_WORDS[COMP_CWORD]} program=${COMP_WORDS[0]} command=${COMP_WORDS[1]-}
    COMPREPLY=()
    # The launcher ./carom would first install and build; the program that it has built is asked instead.
    if [[ $(head -c 2 -- "$(type -P -- "$program")" 2>/dev/null) == '#!' ]]; then
        program=$(dirname -- "$program")/build/release/carom
    fi
    if ((COMP_CWORD == 1)); then
        mapfile -t COMPREPLY < <(compgen -W "$("$program" --help 2>/dev/null |
            sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p') --help --version" -- "$word")
    elif [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$("$program" "$command" --help 2>/dev/null |
            grep -o -- '--[a-z-]*' | sort -u)" -- "$word")
    fi
}
complete -o default -F _carom carom
