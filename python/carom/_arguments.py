"""Arguments of calls, converted for the compiled module, and the errors for those that it does not take."""

from __future__ import annotations

import operator
import os
from typing import Union

from ._carom import SceneError

AnyPath = Union[str, bytes, os.PathLike]

_most_threads = 4096  # as in carom.h
_last_id = 2**32 - 1  # ids have 32 bits


def path(value) -> str:
    """A path as text. Raises ValueError for a path with a null character, which would silently end it early."""
    text = os.fsdecode(value)
    if "\0" in text or not _is_unicode(text):
        raise ValueError(f"the path is {text!r}; expected one in UTF-8, without null characters")
    return text


def text(value, what: str) -> str:
    """A string without lone surrogates, or bytes. Raises TypeError, ValueError."""
    if not isinstance(value, (str, bytes)):
        raise TypeError(f"{what} is a string; not {type(value).__name__}")
    if isinstance(value, str) and not _is_unicode(value):
        raise ValueError(f"{what} holds half a character, {value[:60]!r}; expected Unicode text")
    return value


def threads(value):
    """None means as many as there are cores. Raises SceneError."""
    if value is None:
        return None
    value = operator.index(value)
    if not 1 <= value <= _most_threads:
        raise SceneError(f"threads: is {value}; expected 1 or more, at most {_most_threads}")
    return value


def disk_id(value) -> int:
    """Raises ValueError for a number that cannot be the id of a disk, such as -1."""
    value = operator.index(value)
    if not 0 <= value <= _last_id:
        raise ValueError(f"id is {value}; expected a whole number from 0 to {_last_id}")
    return value


def size(value, name: str):
    """A whole number above 0, for example of bytes or processes; or None."""
    if value is None:
        return None
    value = operator.index(value)
    if value < 1:
        raise ValueError(f"{name} is {value}; expected 1 or more")
    return min(value, 2**62)


def flag(value, name: str) -> bool:
    """Anything that Python takes for true or false, except text, of which "no" would be true. Raises TypeError."""
    if not hasattr(value, "__bool__"):
        raise TypeError(f"{name} is {_named(value)}; expected True or False")
    return bool(value)


def function(value, of: str):
    """Raises TypeError if it cannot be called."""
    if not callable(value):
        raise TypeError(f"expected a function of {of}, not {type(value).__name__}")
    return value


def no_numbers(**arguments) -> Exception:
    """The error to raise if the compiled module has refused one of these as a number."""
    for name, value in arguments.items():
        try:
            if isinstance(value, (str, bytes)):
                raise TypeError
            float(value)
        except OverflowError:
            return ValueError(f"{name} is too large; expected a number below 1.8e308")
        except (TypeError, ValueError):
            return TypeError(f"{name} is {_named(value)}; expected a number")
    return TypeError(f"expected numbers for {', '.join(arguments)}")


def _named(value) -> str:
    shown = repr(value)
    return shown if len(shown) <= 60 and "\n" not in shown else f"of type {type(value).__name__}"


def _is_unicode(text: str) -> bool:
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True
