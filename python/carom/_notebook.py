"""Pages and pictures in notebooks."""

from __future__ import annotations

import base64
import html
import os
import pathlib
import sys
import tempfile

from . import _arguments, _carom
from ._text import in_words_of_python


class Page:
    """A page that a notebook shows in a frame of its own, apart from the notebook's page."""

    def __init__(self, text: str):
        self.text = text

    def _repr_html_(self):
        return ('<iframe style="width: 100%; height: 600px; border: 0" '
                f'srcdoc="{html.escape(self.text)}"></iframe>')


def _in_notebook() -> bool:
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    return getattr(shell, "kernel", None) is not None


def show(trajectory: str, folder: str, file, most_bytes, force):
    """The viewer's page: in a notebook a Page; otherwise written to a file, by default in the folder, and opened."""
    most_bytes = _arguments.size(most_bytes, "max_size")
    force = _arguments.flag(force, "force")
    if file is None and _in_notebook():
        with tempfile.TemporaryDirectory() as folder, in_words_of_python():
            page = os.path.join(folder, "view.html")
            _carom.write_view(trajectory, page, most_bytes, False)
            return Page(pathlib.Path(page).read_text(encoding="utf-8"))
    page = _arguments.path(os.path.join(folder, "view.html") if file is None else file)
    with in_words_of_python():
        _carom.write_view(trajectory, page, most_bytes, force)
    if file is None:
        import webbrowser

        webbrowser.open(pathlib.Path(page).absolute().as_uri())
    return None


def table(rows: dict) -> str:
    cells = "".join(f"<tr><td>{html.escape(name)}</td><td>{html.escape(str(value))}</td></tr>" for name, value in rows.items())
    return f"<table>{cells}</table>"


def image(kind: str, content: bytes) -> str:
    """kind: png or svg+xml. As an image an SVG runs no scripts, and its ids cannot clash with others."""
    return f'<img style="max-width: 100%" src="data:image/{kind};base64,{base64.b64encode(content).decode()}"/>'
