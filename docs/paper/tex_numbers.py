"""Numbers as LaTeX writes them, and the file that defines \\result{key} for all of them."""

import math


def digits(value: float, places: int) -> str:
    """The value with this number of decimal places."""
    return f"{value:.{places}f}"


def significant(value: float, count: int = 2) -> str:
    """The value with count significant digits; from 10^6 on and below 10^-3 as a power of ten."""
    if value == 0.0:
        return "0"
    exponent = math.floor(math.log10(abs(float(f"{value:.{count - 1}e}"))))
    if -4 < exponent < 6:
        return f"{round(value, count - 1 - exponent):.{max(0, count - 1 - exponent)}f}"
    mantissa = f"{value / 10.0**exponent:.{count - 1}f}"
    return f"\\ensuremath{{{mantissa}\\times 10^{{{exponent}}}}}"


def with_error(value: float, error: float) -> str:
    """The value as 1.2345(12), with an error of two digits in the last two places, or as 25.0(3.2) if the decimal point
    is between these."""
    places = max(0, 1 - math.floor(math.log10(float(f"{error:.1e}"))))
    last = f"{error:.1f}" if places == 1 else str(round(error * 10.0**places))
    return f"{value:.{places}f}({last})"


def count(value: int) -> str:
    """A whole number with thin spaces between thousands; a power of ten is written as such."""
    if value >= 1000 and value == 10 ** (len(str(value)) - 1):
        return f"\\ensuremath{{10^{{{len(str(value)) - 1}}}}}"
    return f"{value:,}".replace(",", "\\,") if value >= 10_000 else str(value)


def word(text: str) -> str:
    """The text with LaTeX's special characters escaped."""
    for special in "\\{}$&#_%":
        text = text.replace(special, "\\" + special if special != "\\" else "\\textbackslash{}")
    return text


def definitions(numbers: dict) -> str:
    """The lines that define each key; \\result of another is an error (carom.tex)."""
    return "".join(f"\\defineresult{{{key}}}{{{text}}}\n" for key, text in sorted(numbers.items()))
