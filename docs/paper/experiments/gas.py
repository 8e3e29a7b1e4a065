"""Scenes of equal disks, diameter 1 and mass 1 at temperature 1."""


def periodic_gas(
    disks: int,
    packing: float,
    seed: int = 1,
    positions: str = "random",
    t_end: float = 1.0,
    method: str = "exact",
    dt: float = 0.01,
    **tables,
) -> dict:
    """A gas in a square periodic box; tables are added to those of the scene."""
    sides = {side: "periodic" for side in ("left", "right", "bottom", "top")}
    scene = {
        "seed": seed,
        "box": {"packing_fraction": packing, **sides, **tables.pop("box", {})},
        "disks": [{"count": disks, "positions": positions, "velocities": {"maxwell": 1.0}, "radius": 0.5, "mass": 1.0}],
        "run": {"method": method, "dt": dt, "t_end": t_end},
    }
    return scene | tables
