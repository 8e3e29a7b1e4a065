"""Makes the paper: build/paper/carom.pdf.

    ./carom paper                     from the results that are kept (docs/paper/results), a few seconds
    ./carom paper --full [NAME...]    makes the named experiments anew first, or all (a quarter of an hour on an idle machine)

Every figure and every measured number of the paper comes from those results. The same results give the same bytes.
"""

import argparse
import importlib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import kept_results
import tex_numbers
from experiments import NAMES

HERE = Path(__file__).parent
BUILD = HERE.parents[1] / "build"
OF_THE_METHODS = ["model", "methods", "exact_window", "determinism"]  # these contain constants of the program itself
SAME_DATE = {"SOURCE_DATE_EPOCH": "0", "FORCE_SOURCE_DATE": "1", "TZ": "UTC", "LC_ALL": "C.UTF-8"}


def experiment(name: str):
    return importlib.import_module(f"experiments.{name}")


def run_experiments(names: list) -> None:
    for name in names:
        print(f"paper: {name}", file=sys.stderr, flush=True)
        kept_results.keep(name, experiment(name).run())


def write_results(folder: Path) -> None:
    """Writes numbers.tex and the figures of all experiments."""
    numbers = {}
    for name in NAMES:
        try:
            result = kept_results.kept(name)
        except FileNotFoundError:
            sys.exit(f"paper: no results of {name} are kept; ./carom paper --full {name} makes them")
        made = experiment(name)
        own = made.numbers(result["rows"])
        own["commit"] = tex_numbers.word(result["commit"])
        own["machine"] = tex_numbers.word(result["machine"]["processor"])
        numbers |= {f"{name}.{key}": text for key, text in own.items()}
        if hasattr(made, "draw"):
            made.draw(result["rows"], folder)
    (folder / "numbers.tex").write_text(tex_numbers.definitions(numbers))


def typed_numbers() -> list:
    """Lists decimals in the text that no program wrote, by lines of the sections; formulas, lengths and the sections on
    methods are left out."""
    faults = []
    for source in sorted(set(HERE.glob("*.tex")) - {HERE / f"{name}.tex" for name in OF_THE_METHODS}):
        for k, line in enumerate(source.read_text().splitlines(), 1):
            text = re.sub(r"%.*|\\result\{[^}]*\}|\$[^$]*\$|[\d.]+(\\linewidth|cm)", "", line)
            if re.search(r"\d\.\d", text):
                faults.append(f"{source.name}:{k}: {line.strip()}")
    return faults


def typeset(folder: Path) -> None:
    """Runs LaTeX as often as it asks for; on an error, ends the program with the error lines of its log."""
    for source in [*HERE.glob("*.tex"), *HERE.glob("*.bib")]:
        shutil.copy(source, folder)
    done = subprocess.run(
        ["latexmk", "-pdf", "-interaction=nonstopmode", "-halt-on-error", "-silent", "carom.tex"],
        cwd=folder,
        env=os.environ | SAME_DATE,
        capture_output=True,
        text=True,
    )
    log = (folder / "carom.log").read_text(errors="replace") if (folder / "carom.log").exists() else done.stdout
    faults = [
        line for line in log.splitlines() if line.startswith("!") or "undefined" in line or "multiply defined" in line
    ]
    if done.returncode != 0 or faults:
        sys.exit("paper: LaTeX failed:\n" + "\n".join(faults or [done.stdout, done.stderr]))


def main() -> None:
    parser = argparse.ArgumentParser(
        prog="carom paper", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, allow_abbrev=False
    )
    parser.add_argument(
        "--full", nargs="*", metavar="NAME", help="make these experiments anew, or all: " + ", ".join(NAMES)
    )
    parser.add_argument(
        "--quick", action="store_true", help="from the kept results alone (what happens without --full)"
    )
    options = parser.parse_args()
    if options.full is not None:
        if options.quick:
            parser.error("--quick and --full: expected one of them")
        for name in options.full:
            if name not in NAMES:
                parser.error(f"{name}: no experiment has this name; they are {', '.join(NAMES)}")
        run_experiments(options.full or NAMES)

    typed = typed_numbers()
    if typed:
        sys.exit("paper: a measured number is written by a program, as \\result{key}; typed are\n" + "\n".join(typed))
    folder = BUILD / "paper"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    os.environ.update(SAME_DATE)
    write_results(folder)
    typeset(folder)
    print(folder / "carom.pdf")


if __name__ == "__main__":
    try:
        main()
    except (RuntimeError, OSError, subprocess.CalledProcessError) as fault:
        sys.exit(f"paper: {fault}")
