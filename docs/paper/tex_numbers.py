"""Numbers as LaTeX writes them, and the file that defines \\result{key} for all of them."""

import math


def digits(value: float, places: int) -> str:
    """With so many places after the point."""
    return f"{value:.{places}f}"


def significant(value: float, count: int = 2) -> str:
    """With so many significant digits; from 10^6 on and below 10^-3 as a power of ten."""
    if value == 0.0:
        return "0"
    exponent = math.floor(math.log10(abs(float(f"{value:.{count - 1}e}"))))
    if -4 < exponent < 6:
        return f"{round(value, count - 1 - exponent):.{max(0, count - 1 - exponent)}f}"
    mantissa = f"{value / 10.0**exponent:.{count - 1}f}"
    return f"\\ensuremath{{{mantissa}\\times 10^{{{exponent}}}}}"


def with_error(value: float, error: float) -> str:
    """As 1.2345(12): the error, of two digits, is of the last two places; 25.0(3.2) where the point lies between these."""
    places = max(0, 1 - math.floor(math.log10(float(f"{error:.1e}"))))
    last = f"{error:.1f}" if places == 1 else str(round(error * 10.0**places))
    return f"{value:.{places}f}({last})"


def count(value: int) -> str:
    """A whole number with thin spaces between thousands; a power of ten as such."""
    if value >= 1000 and value == 10 ** (len(str(value)) - 1):
        return f"\\ensuremath{{10^{{{len(str(value)) - 1}}}}}"
    return f"{value:,}".replace(",", "\\,") if value >= 10_000 else str(value)


def word(text: str) -> str:
    """A text whose special characters LaTeX would read."""
    for special in "\\{}$&#_%":
        text = text.replace(special, "\\" + special if special != "\\" else "\\textbackslash{}")
    return text


def definitions(numbers: dict) -> str:
    """The lines that define each key; \\result of another is an error (carom.tex)."""
    return "".join(f"\\defineresult{{{key}}}{{{text}}}\n" for key, text in sorted(numbers.items()))
