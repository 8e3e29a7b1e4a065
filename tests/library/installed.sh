#!/bin/bash
# Installs a build to an empty prefix and builds examples/ with it as users would; every way must give the same hashes.
#   installed.sh BUILD SOURCE [sources]     with sources: again from Carom's sources, by add_subdirectory (slow)
set -euo pipefail
build=$1 source=$2
work=$(mktemp -d)
# The sources are built in a folder beside the build, and with its warnings, so that the compiler cache has the files
# that it compiled.
part=$(realpath "$build")-sources
trap 'rm -rf "$work" "$part" "$part.log"' EXIT
rm -rf "$part"
prefix=$work/prefix
examples="hello hello_cpp billiards hopper rollback"

say() { printf '%s\n' "$*"; }

# The installed tree is moved, and must still find everything below its prefix.
cmake --install "$build" --prefix "$work/first" >/dev/null
mv "$work/first" "$prefix"
libraries=$(dirname "$(find "$prefix" -name libcarom.so)")
for file in bin/carom include/carom/carom.h include/carom/carom.hpp share/man/man1/carom.1 share/bash-completion/completions/carom \
    share/doc/carom/copyright share/doc/libcarom-dev/copyright; do
    [[ -s $prefix/$file ]] || { say "$file is not installed" && exit 1; }
done
readelf -d "$libraries/libcarom.so" | grep -q 'SONAME.*\[libcarom\.so\.[0-9]*\]' || { say "libcarom.so has no soname" && exit 1; }

# The hashes that the programs in a folder print.
hashes() { # FOLDER
    local example
    for example in $examples; do
        say "$example $("$1/$example" | grep '^hash' | tr '\n' ' ')"
    done
}

# Prints nothing unless it fails.
configure_and_build() { # SOURCE FOLDER OPTION...
    if ! { cmake -S "$1" -B "$2" -G Ninja "${@:3}" && cmake --build "$2"; } >"$2.log" 2>&1; then
        cat "$2.log" >&2
        exit 1
    fi
}

with_cmake() { # FOLDER OPTION...
    configure_and_build "$source/examples" "$1" -DCMAKE_BUILD_TYPE=Release "${@:2}"
    hashes "$1"
}

with_pkg_config() { # FOLDER FLAG...
    local folder=$work/$1 example file flags
    mkdir "$folder"
    # shellcheck disable=SC2207  # the flags are to be split into words
    flags=($(PKG_CONFIG_PATH=$libraries/pkgconfig pkg-config --cflags --libs carom))
    for example in $examples; do
        file=$(echo "$source/examples/$example".c*)
        if [[ $file == *.c ]]; then
            ${CC:-cc} -O1 "${@:2}" "$file" -o "$folder/$example" "${flags[@]}" -Wl,-rpath,"$libraries"
        else
            ${CXX:-c++} -std=c++20 -O1 "${@:2}" "$file" -o "$folder/$example" "${flags[@]}" -Wl,-rpath,"$libraries"
        fi
    done
    hashes "$folder"
}

same() { # WHAT HASHES
    [[ $2 == "$wanted" ]] || { printf '%s gives\n%s\nand pkg-config\n%s\n' "$1" "$2" "$wanted" && exit 1; }
    say "$1: the same hashes"
}

wanted=$(with_pkg_config plain)
say "$wanted"
[[ $(grep -o '[0-9a-f]\{16\}' <<<"$wanted" | wc -l) == 6 ]] || { say "an example prints no hash" && exit 1; }
same "-ffast-math" "$(with_pkg_config fast -ffast-math)"
same "find_package" "$(with_cmake "$work/installed" -DCMAKE_PREFIX_PATH="$prefix")"
[[ ${3-} != sources ]] || same "add_subdirectory" "$(with_cmake "$part" -DCAROM_SOURCE="$source" -DCAROM_WERROR=ON)"

# In a project that does not set an optimisation the sources are compiled without, and CMake says so.
[[ $(cmake -S "$source/examples" -B "$work/untyped" -G Ninja -DCAROM_SOURCE="$source" 2>&1) == *"without optimisation"* ]] ||
    { say "no word of a build without optimisation" && exit 1; }
say "a build without optimisation: said"

# The static library, with all the libraries that it needs, in a project with C and C++ and in one with C only.
for languages in "C CXX" C; do
    cat >"$work/CMakeLists.txt" <<EOP
cmake_minimum_required(VERSION 3.25)
project(static LANGUAGES $languages)
find_package(Carom REQUIRED COMPONENTS static)
add_executable(hello $source/examples/hello.c)
target_link_libraries(hello PRIVATE Carom::static)
EOP
    configure_and_build "$work" "$work/static-${languages/ /-}" -DCMAKE_PREFIX_PATH="$prefix"
    [[ $("$work/static-${languages/ /-}/hello" | grep '^hash') == "$(sed -n 's/^hello \(.*\) $/\1/p' <<<"$wanted")" ]] ||
        { say "the static library has another hash in $languages" && exit 1; }
done
say "static library: the same hash"

# A program that uses the shared library needs no headers or .pc files of the libraries that Carom uses.
alone=$(PKG_CONFIG_LIBDIR=$libraries/pkgconfig PKG_CONFIG_PATH='' pkg-config --cflags --libs carom) || { say "carom.pc asks for other packages" && exit 1; }
[[ $alone != *cairo* ]] || { say "carom.pc gives flags of other packages: $alone" && exit 1; }
say "pkg-config: without other packages"
# If there is MPI, --ranks works with the installed program.
if [[ -x $build/carom-mpi && ! -x $prefix/bin/carom-mpi ]]; then say "carom-mpi is not installed" && exit 1; fi

# Completion offers the commands and the options of --help.
complete_with() { # WORDS...
    bash -c "source '$prefix/share/bash-completion/completions/carom'"'
        COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)); _carom; printf "%s " "${COMPREPLY[@]}"' bash "$@"
}
[[ $(complete_with "$prefix/bin/carom" re) == "resume render " ]] || { say "completion of commands" && exit 1; }
[[ $(complete_with "$prefix/bin/carom" run --th) == "--threads " ]] || { say "completion of options" && exit 1; }
grep -q 'max\\-walltime' "$prefix/share/man/man1/carom.1" || { say "the manual page lacks options" && exit 1; }
say "manual page and completion: there"
