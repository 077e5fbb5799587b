"""The frames of `rowpilot bench detector`: paper A's stages and times of day (Table 4), farms never seen."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from navcore.sim.camera_light import LightName
from navcore.sim.orchard import Season
from navcore.training.dataset import SHOTS_PER_SCENE, render_dataset
from navcore.training.dataset_recipe import Setting
from navcore.training.samples import Sample, read_samples

STAGES = (Season.BUDDING, Season.GROWING, Season.MATURING)
LIGHTS = (LightName.NOON, LightName.AFTERNOON, LightName.EVENING)
# Sets of different seeds share no farm; below 1000 are training, validation and what things are tuned on.
SEED = 1903


@dataclass(frozen=True, slots=True, kw_only=True)
class FrameParams:
    """Attributes: farms: per stage and light, with a dozen pictures each; processes: that render."""

    farms: int = 10
    processes: int = 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Cell:
    """A stage at a time of day, with its labelled pictures."""

    stage: Season
    light: LightName
    seed: int
    samples: tuple[Sample, ...]


def render_cells(folder: Path, params: FrameParams) -> Iterator[Cell]:
    """All nine, one after the other, written to folders of their own in `folder`."""
    for number, (stage, light) in enumerate((s, t) for s in STAGES for t in LIGHTS):
        own, setting = folder / f"{stage}-{light}", Setting(season=stage, light=light)
        count, seed = params.farms * SHOTS_PER_SCENE, SEED + number
        render_dataset(own, count=count, seed=seed, processes=params.processes, setting=setting)
        yield Cell(stage=stage, light=light, seed=seed, samples=read_samples(own))
