"""docs/tour.ipynb and examples/sweep_dask.py give the results that they state.

The notebook's cells are run here in their order, in one namespace, and the value of a cell's last line is shown as in a
notebook. Jupyter itself is not used: its kernel and the forty packages that it needs are not under test.
"""

import ast
import json
import os
import pathlib
import subprocess
import sys

import carom
import pytest

source = pathlib.Path(os.environ["CAROM_SOURCE_DIR"])


def run_cells(notebook, names):
    """Runs the cells and returns the pages (or texts) that are shown by cells that end with an expression."""
    shown = []
    for cell in json.loads(notebook.read_text())["cells"]:
        if cell["cell_type"] != "code":
            continue
        body = ast.parse("".join(cell["source"]), str(notebook)).body
        last = body.pop() if isinstance(body[-1], ast.Expr) else None
        exec(compile(ast.Module(body, []), str(notebook), "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), str(notebook), "eval"), names)
            shown.append(value._repr_html_() if hasattr(value, "_repr_html_") else repr(value))
    return shown


def test_the_tour(monkeypatch, capsys):
    monkeypatch.chdir(source / "docs")
    names = {"__name__": "tour"}
    shown = run_cells(source / "docs/tour.ipynb", names)
    assert "pair_correlation" in names["result"].plots and "svg+xml" in "".join(shown)
    assert abs(names["z"] - 4.105) < 5.0 * names["error"] + 0.01 and 0.0 < names["error"] < 0.1
    assert abs(names["z_of_rate"] - names["z"]) < 5.0 * names["error"]
    assert abs(names["z_of_g"] - 4.105) < 0.25
    assert 1.0 < names["peak"] < 1.1
    for fraction, z in names["swept"].items():
        assert abs(z / names["table"][fraction] - 1.0) < 0.03
    assert "published 4.105" in capsys.readouterr().out


def test_a_sweep_over_two_workers():
    pytest.importorskip("distributed")
    line = [sys.executable, source / "examples/sweep_dask.py"]
    done = subprocess.run(line, check=True, capture_output=True, text=True, timeout=100)
    assert "Traceback" not in done.stderr, done.stderr
    told = done.stdout.splitlines()
    z = {float(f): float(value) for f, value in (row.split() for row in told[:3])}
    for fraction, published in ((0.1, 1.236144), (0.3, 2.06326)):
        assert abs(z[fraction] / published - 1.0) < 0.03
    sys.path.insert(0, str(source / "examples"))
    import sweep_dask

    assert told[3].split()[1] == carom.run(sweep_dask.gas(0.1, 1), threads=1).hash
