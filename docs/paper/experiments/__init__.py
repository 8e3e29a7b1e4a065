"""The experiments of the paper. Each module has

    run() -> rows             makes the runs; the rows are kept in results/NAME.json
    numbers(rows) -> dict     key: LaTeX text, for \\result{NAME.key}
    draw(rows, folder)        if there is a figure: NAME.tex and NAME.pdf
"""

NAMES = [
    "equation_of_state",
    "cooling",
    "absorbing_square",
    "shear_viscosity",
    "reversal",
    "counting_pi",
    "equal_bits",
    "borders",
    "chart",
    "stability",
    "standstill",
    "exact_speed",
    "pairwise_speed",
    "counts",
    "memory",
    "ranks",
]
