"""Dictionaries as TOML, which is how scenes are read and checked; and messages of the command line in the words of
Python."""

from __future__ import annotations

import contextlib
import json
import re
from typing import Any, Mapping

from . import _arguments
from ._carom import PhysicsError, SceneError

_bare = re.compile(r"[A-Za-z0-9_-]+")


def _quoted(text: str) -> str:
    """A string as a TOML string. JSON differs in two ways: it may contain a DEL, and pairs of surrogates."""
    return json.dumps(_arguments.text(text, "a name or a value of a scene"), ensure_ascii=False).replace("\x7f", "\\u007f")


def _key(name) -> str:
    if not isinstance(name, str):
        raise TypeError(f"the keys of a scene are strings; not {type(name).__name__}")
    return name if _bare.fullmatch(name) else _quoted(name)


def value(v: Any, where: str) -> str:
    """A value in TOML: numbers in full precision, whatever their class prints; those of numpy like Python's. where: its
    key."""
    if hasattr(v, "tolist"):
        v = v.tolist()
    if isinstance(v, bool):
        return "true" if v else "false"
    if isinstance(v, int):
        return int.__repr__(v)
    if isinstance(v, float):
        return float.__repr__(v)
    if isinstance(v, str):
        return _quoted(v)
    if isinstance(v, Mapping):
        return "{ " + ", ".join(f"{_key(k)} = {value(item, f'{where}.{k}')}" for k, item in v.items()) + " }"
    if isinstance(v, (list, tuple)):
        return "[" + ", ".join(value(item, f"{where}.{n}") for n, item in enumerate(v)) + "]"
    if hasattr(v, "__fspath__"):
        return _quoted(v.__fspath__())
    raise TypeError(f"{where}: a scene holds numbers, strings, lists and dictionaries; not {type(v).__name__}")


def _is_table_list(v) -> bool:
    return isinstance(v, (list, tuple)) and len(v) > 0 and all(isinstance(item, Mapping) for item in v)


def toml(tables: Mapping[str, Any]) -> str:
    """The tables of a scene, with plain keys first, as in a file."""
    if not isinstance(tables, Mapping):
        raise TypeError(f"a scene is a dictionary, not {type(tables).__name__}; carom.Scene.load(path) reads a file, "
                        "carom.Scene.parse(text) text")
    plain, rest = [], []
    for name, item in tables.items():
        if isinstance(item, Mapping):
            rest += [f"[{_key(name)}]"] + _lines(item, name)
        elif _is_table_list(item):
            for n, entry in enumerate(item):
                rest += [f"[[{_key(name)}]]"] + _lines(entry, f"{name}.{n}")
        else:
            plain.append(f"{_key(name)} = {value(item, name)}")
    return "\n".join(plain + rest) + "\n"


def _lines(table: Mapping[str, Any], where: str) -> list:
    return [f"{_key(k)} = {value(v, f'{where}.{k}')}" for k, v in table.items()]


def overrides(changes: Mapping[str, Any]) -> list:
    if not isinstance(changes, Mapping):
        raise TypeError(f"changes are a dictionary, such as {{\"run.t_end\": 5.0}}; not {type(changes).__name__}")
    for key in changes:
        if not isinstance(key, str):
            raise TypeError(f"the keys of changes are strings, such as \"run.t_end\"; not {type(key).__name__}")
    return [(key, value(v, key)) for key, v in changes.items()]


def words_of_python(text: str) -> str:
    """Messages with -o, --set, --force and --strict of the command line replaced by the arguments here."""
    text = text.replace(" with -o", "").replace(" (-o)", "").replace("such as -o ", "such as ").replace("--force", "force=True")
    text = text.replace("--max-size:", "max_size:").replace("--engine:", "engine:").replace("--strict", "strict=True")
    if text.startswith("--set "):  # elsewhere in a line it is a command to type
        text = f"changes: {text[6:]}"
    return f"file:{text[3:]}" if text.startswith("-o:") else text


@contextlib.contextmanager
def in_words_of_python():
    """Errors raised within use the words of Python, too."""
    try:
        yield
    except (SceneError, PhysicsError) as error:
        raise type(error)(words_of_python(str(error))) from None
