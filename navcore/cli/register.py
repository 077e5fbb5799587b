"""`rowpilot register`: where one cloud lies on another."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from navcore.geometry.se3 import SE3
    from navcore.localization.ndt.registration import Registration
    from navcore.maps.cloud_files.file_cloud import FileCloud

NOT_FOUND, BAD_INPUT = 1, 2


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command("register")(register_clouds)


def register_clouds(
    source: Annotated[Path, typer.Argument(help="Cloud to lay onto the other: .pcd, .ply, .las, .laz, KITTI .bin.")],
    target: Annotated[Path, typer.Argument(help="Cloud that stays where it is.")],
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object.")] = False,
    start: Annotated[
        tuple[float, float, float, float], typer.Option(metavar="X Y Z YAW", help="A guess of the source, m and deg.")
    ] = (0.0, 0.0, 0.0, 0.0),
    reach: Annotated[float, typer.Option(min=0.0, max=20.0, help="How far off the guess may be, m.")] = 0.8,
    turn_deg: Annotated[float, typer.Option(min=0.0, max=180.0, help="How far turned it may be, deg.")] = 12.0,
) -> None:
    """T_target_source, its covariance and score, and the milliseconds it took, not counting reading and compiling.

    Ends with 1 where the clouds do not fit together, with 2 where a file cannot be used.
    """
    from navcore.errors import RowpilotError

    try:
        found = _registered(source, target, start, (reach, turn_deg))
    except RowpilotError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None
    for line in _json(found) if as_json else _table(found):
        typer.echo(line)
    if found["reason"]:
        raise typer.Exit(NOT_FOUND)


def _registered(
    source: Path, target: Path, start: tuple[float, float, float, float], search: tuple[float, float]
) -> dict[str, Any]:
    import math
    import time

    from navcore.geometry.se3 import SE3
    from navcore.localization.ndt.cloud_pair import CloudPair
    from navcore.maps.cloud_files.cloud_file import read_cloud

    clouds = read_cloud(source), read_cloud(target)
    points, target_points = _in_one_frame(*clouds), clouds[1].cloud.points
    guess = SE3.from_rpy(start[:3], yaw=math.radians(start[3]))
    params = _params(*search)
    CloudPair(target_points[:1000], params).register(points, guess)  # compiles
    began = time.perf_counter()
    pair = CloudPair(target_points, params)
    mapped = time.perf_counter()
    found = pair.register(points, guess)
    ended = time.perf_counter()
    return _told(found, clouds, (1e3 * (mapped - began), 1e3 * (ended - mapped)))


def _params(reach: float, turn_deg: float) -> Any:
    import math

    from navcore.localization.ndt.cloud_pair import CloudPairParams
    from navcore.localization.ndt.ndt_matcher import NdtMatcherParams
    from navcore.localization.ndt.start_search import StartSearchParams

    search = StartSearchParams(reach=reach, turn=math.radians(turn_deg))
    return CloudPairParams(
        matcher=NdtMatcherParams(search=search, guess_std=max(1.0, reach), guess_turn_std=max(0.3, search.turn))
    )


def _in_one_frame(source: FileCloud, target: FileCloud) -> Any:
    """The source's points about the target's origin."""
    import numpy as np

    from navcore.errors import CloudError

    for cloud, name in ((source, "SOURCE"), (target, "TARGET")):
        if not len(cloud.cloud):
            raise CloudError(f"{name} holds no points; give a cloud that does.")
    if source.crs and target.crs and source.crs != target.crs:
        raise CloudError(f"SOURCE is in {source.crs}, TARGET in {target.crs}; bring them to one system first.")
    return source.cloud.points + (np.asarray(source.origin) - np.asarray(target.origin))


def _told(found: Registration, clouds: tuple[FileCloud, FileCloud], ms: tuple[float, float]) -> dict[str, Any]:
    T: SE3 = found.T_target_source
    return {
        "T_target_source": T.matrix().tolist(),
        "origin": list(clouds[1].origin),
        "covariance": found.covariance.tolist(),
        "score": found.score,
        "milliseconds": ms[1],
        "map_milliseconds": ms[0],
        "overlap": found.overlap,
        "iterations": found.iterations,
        "converged": found.converged,
        "reason": found.reason,
        "weak": [{"direction": w.direction.tolist(), "std": w.std} for w in found.weak],
        "points": [len(cloud.cloud) for cloud in clouds],
        "dropped": [cloud.dropped for cloud in clouds],
    }


def _json(found: dict[str, Any]) -> list[str]:
    import json

    return [json.dumps(found, allow_nan=False)]


def _table(found: dict[str, Any]) -> list[str]:
    import math

    import numpy as np

    from navcore.geometry.se3 import SE3

    T = np.array(found["T_target_source"])
    angles = [math.degrees(a) for a in SE3(T[:3, :3], T[:3, 3]).rpy()]
    std = np.sqrt(np.diag(found["covariance"]))
    lines = ["T_target_source", *("  " + " ".join(f"{value:12.6f}" for value in row) for row in T)]
    if any(found["origin"]):
        lines.append("  of coordinates less " + ", ".join(f"{value:.0f}" for value in found["origin"]) + " m")
    lines += [
        f"x {T[0, 3]:.3f}  y {T[1, 3]:.3f}  z {T[2, 3]:.3f} m, 1-sigma " + " ".join(f"{s:.3f}" for s in std[:3]),
        f"roll {angles[0]:.2f}  pitch {angles[1]:.2f}  yaw {angles[2]:.2f} deg, 1-sigma "
        + " ".join(f"{math.degrees(s):.2f}" for s in std[3:]),
        f"score {found['score']:.3f}, {found['overlap']:.0%} of SOURCE on TARGET, {found['iterations']} steps",
        f"{found['milliseconds']:.1f} ms, and {found['map_milliseconds']:.1f} ms for the target's cells",
    ]
    lines += [f"weak along {np.round(w['direction'], 2).tolist()}, 1-sigma {w['std']:.2f} m" for w in found["weak"]]
    lines += [f"{count} points of {name} were NaN" for name, count in zip(("SOURCE", "TARGET"), found["dropped"],
                                                                          strict=True) if count]  # fmt: skip
    return lines + ([found["reason"]] if found["reason"] else [])
