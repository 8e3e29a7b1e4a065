"""Figures: gnuplot draws lines and points, and LaTeX sets the text in the fonts of the paper."""

import subprocess
from pathlib import Path

COLOURS = ["#1f5fa8", "#c2410c", "#2f7d32", "#7b3fa0", "#6b7280", "#b08900"]

STYLE = """
set terminal cairolatex pdf size {width}cm,{height}cm color dashed fontscale 0.65 linewidth 1.4
set border linewidth 0.7 linecolor rgb "#333333"
set tics scale 0.6 nomirror
set grid linewidth 0.4 linecolor rgb "#dddddd"
set key samplen 1.6 spacing 1.1 reverse Left
set bars 0.6
"""


def block(name: str, rows: list) -> str:
    """Makes a data block $name from rows of numbers; an empty row separates the lines of a curve."""
    return (
        f"${name} << EOD\n"
        + "".join(" ".join(f"{x:.10g}" if not isinstance(x, str) else x for x in row) + "\n" for row in rows)
        + "EOD\n"
    )


def draw(folder: Path, name: str, commands: str, width: float = 7.8, height: float = 6.4) -> None:
    """Writes name.tex and name.pdf to the folder. Raises subprocess.CalledProcessError if gnuplot fails."""
    colours = "".join(
        f'set linetype {k + 1} linecolor rgb "{c}" pointtype {p}\n'
        for k, (c, p) in enumerate(zip(COLOURS, [7, 5, 9, 11, 13, 6]))
    )
    script = STYLE.format(width=width, height=height) + colours + f'set output "{name}.tex"\n' + commands
    (folder / f"{name}.gp").write_text(script)
    subprocess.run(["gnuplot", f"{name}.gp"], cwd=folder, check=True)
