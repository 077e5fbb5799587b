"""A camera's intrinsics and lens from pictures of a board, and whether they can be trusted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board import BoardSighting
from navcore.calibration.coverage import alike
from navcore.calibration.intrinsics_fit import PARAMETERS, IntrinsicsFit, fit_intrinsics, left_out_residuals, rms_px
from navcore.errors import CalibrationError, NotFiniteError
from navcore.geometry.intrinsics import Intrinsics
from navcore.geometry.lens import Lens

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class IntrinsicsParams:
    """What is asked of the pictures. Ours; set on rendered boards.

    Attributes:
        least_poses: with fewer the lens is not told; 4 or more. Paper B takes 20.
        stands_out: a picture whose error is so many times the others' median is thrown out; > 1.
        stands_out_px: and is above this, px, so that clean sets lose none.
        most_thrown_out: share of the pictures; with more the set is refused. 0 to 0.5.
        worst_px: largest root mean square error of all; more means two cameras, or a bent board. > 0.
        least_spread_deg: root mean square angle of the boards to their mean; 2 or more.
        worst_focal: largest 1-sigma of the focal lengths, share; more means that the boards stood alike.
        folds: parts that are left out in turn for the error on unseen pictures; 2 or more.
    """

    least_poses: int = 8
    stands_out: float = 2.5
    stands_out_px: float = 0.15
    most_thrown_out: float = 0.34
    worst_px: float = 1.0
    least_spread_deg: float = 5.0
    worst_focal: float = 0.01
    folds: int = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureError:
    """How well one picture is explained.

    Attributes:
        rms_px: of its corners' distances. left_out_px: the same by a camera fitted without the picture.
    """

    name: str
    rms_px: float
    left_out_px: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CameraIntrinsics:
    """What was found.

    Attributes:
        std: 1-sigma of each of `PARAMETERS` by name: fx, fy, cx, cy in px, the lens' without unit.
        rms_px, left_out_px: over all corners, root mean square; the second on pictures that the fit had not seen.
        pictures: in the order of the sightings kept. thrown_out: name and reason of those that were not.
        sightings: those kept. residuals: of each (N, 2) seen minus explained corners, px.
    """

    camera: Intrinsics
    lens: Lens
    std: dict[str, float]
    rms_px: float
    left_out_px: float
    pictures: tuple[PictureError, ...]
    thrown_out: tuple[tuple[str, str], ...]
    sightings: tuple[BoardSighting, ...]
    residuals: tuple[Floats, ...]


def calibrate_intrinsics(sightings: Sequence[BoardSighting], params: IntrinsicsParams) -> CameraIntrinsics:
    """Zhang's method without the pictures that stand out. Raises CalibrationError with every reason."""
    _check(sightings, params)
    fit, kept, thrown_out = _without_outliers(sightings, params)
    _check_fit(fit, params)
    left_out = left_out_residuals(kept, min(params.folds, len(kept)))
    return CameraIntrinsics(
        camera=fit.camera, lens=fit.lens, std=dict(zip(PARAMETERS, map(float, fit.std), strict=True)),
        rms_px=rms_px(fit.residuals), left_out_px=rms_px(left_out),
        pictures=tuple(
            PictureError(name=s.name, rms_px=rms_px([r]), left_out_px=rms_px([o]))
            for s, r, o in zip(kept, fit.residuals, left_out, strict=True)
        ),
        thrown_out=tuple(thrown_out), sightings=tuple(kept), residuals=fit.residuals,
    )  # fmt: skip


def _check(sightings: Sequence[BoardSighting], params: IntrinsicsParams) -> None:
    if not all(np.all(np.isfinite(s.pixels)) and np.all(np.isfinite(s.points)) for s in sightings):
        raise NotFiniteError("A corner of a board is NaN or infinite.")
    if len({s.size for s in sightings}) > 1:
        sizes = ", ".join(sorted({f"{w}x{h}" for w, h in (s.size for s in sightings)}))
        raise CalibrationError((f"The pictures have different sizes ({sizes}). Take all with one camera setting.",))
    distinct = len(sightings) - alike(sightings)
    if distinct < params.least_poses:
        same = f", {len(sightings) - distinct} more show it where another does" if distinct < len(sightings) else ""
        raise CalibrationError(
            (
                f"{distinct} {'picture shows' if distinct == 1 else 'pictures show'} the board in a place of its own"
                f"{same}; {params.least_poses} are needed and 20 are good. Move and tilt it between pictures.",
            )
        )


def _without_outliers(
    sightings: Sequence[BoardSighting], params: IntrinsicsParams
) -> tuple[IntrinsicsFit, list[BoardSighting], list[tuple[str, str]]]:
    """The fit, what it rests on, and what was thrown out, the worst first: a wrong picture spoils others' errors."""
    kept, thrown_out = list(sightings), list[tuple[str, str]]()
    while True:
        fit = fit_intrinsics(kept)
        errors = [rms_px([r]) for r in fit.residuals]
        worst, usual = int(np.argmax(errors)), float(np.median(errors))
        if errors[worst] <= max(params.stands_out_px, params.stands_out * usual):
            return fit, kept, thrown_out
        reason = f"its error of {errors[worst]:.2f} px stands out from the others' {usual:.2f} px"
        thrown_out.append((kept.pop(worst).name, reason))
        if len(kept) < params.least_poses or len(thrown_out) > params.most_thrown_out * len(sightings):
            raise _contradiction(", ".join(name for name, _ in thrown_out) + " do not fit the rest")


def _contradiction(what: str) -> CalibrationError:
    return CalibrationError(
        (
            f"The pictures contradict each other: {what}. Look whether the board is flat, its size is right, and all "
            "pictures are of one camera that was not touched.",
        )
    )


def _check_fit(fit: IntrinsicsFit, params: IntrinsicsParams) -> None:
    """Whether it can be trusted. Of boards that stand parallel OpenCV tells a focal length, and no doubt about it."""
    if (error := rms_px(fit.residuals)) > params.worst_px:
        raise _contradiction(f"even the best camera is {error:.1f} px off")
    share = max(fit.std[0] / fit.camera.fx, fit.std[1] / fit.camera.fy)
    if spread_deg(fit.normals) < params.least_spread_deg or share > params.worst_focal:
        raise CalibrationError(
            (
                "These pictures tell no focal length: all boards stand parallel, or small in the picture. Tilt the "
                "board by 30 deg to all sides, and hold it nearer.",
            )
        )


def spread_deg(normals: Floats) -> float:
    """Root mean square angle of unit vectors (N, 3) to their mean, deg."""
    mean = normals.mean(axis=0)
    cosines = np.clip(normals @ mean / np.linalg.norm(mean), -1.0, 1.0)
    return float(np.degrees(np.sqrt(np.mean(np.arccos(cosines) ** 2))))
