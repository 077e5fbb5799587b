"""Every primitive is in exactly one chunk, and inside of its sphere."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.maps.site_map import Datum, Row, SiteMap
from navcore.sim.orchard import OrchardParams, Season, Trellis
from navcore.sim.planting import build_orchard
from navcore.sim.render.canopy import leaf_cards
from navcore.sim.render.planting import planted
from navcore.sim.render.primitives import Chunks, into_chunks


def chunks(trellis: Trellis, season: Season = Season.MATURING) -> Chunks:
    row = Row(id="r", start=(3.0, -2.0), end=(25.0, 11.0))
    site = SiteMap(name="s", datum=Datum(lat_deg=0.0, lon_deg=0.0, height_m=0.0), rows=(row,))
    orchard = build_orchard(site, OrchardParams(trellis=trellis, season=season))
    return into_chunks(planted(orchard, leaf_cards(orchard)))


@pytest.mark.parametrize("trellis", list(Trellis))
def test_every_primitive_is_in_one_chunk(trellis: Trellis) -> None:
    c = chunks(trellis)
    for column, kind in ((0, c.tubes), (2, c.beams), (4, c.cards), (6, c.panels)):
        assert c.span[0, column] == 0
        assert c.span[-1, column + 1] == len(kind)
        assert np.array_equal(c.span[1:, column], c.span[:-1, column + 1])


@pytest.mark.parametrize("trellis", list(Trellis))
def test_every_primitive_lies_within_the_sphere_that_it_is_culled_by(trellis: Trellis) -> None:
    c = chunks(trellis)
    for head, span in zip(c.head, c.span, strict=True):
        corners = [c.tubes[span[0] : span[1], :, :3].reshape(-1, 3), c.beams[span[2] : span[3], :3]]
        corners += [c.beams[span[2] : span[3], 3:6]]
        cards = c.cards[span[4] : span[5]]
        corners += [cards[:, :3] + a * cards[:, 3:6] + b * cards[:, 6:9] for a in (-1, 1) for b in (-1, 1)]
        assert np.linalg.norm(np.concatenate(corners) - head[:3], axis=1).max() <= head[3] + 1e-9


def test_leaves_hang_between_the_canopys_bottom_and_top() -> None:
    c = chunks(Trellis.VSP)
    leaves = c.cards[c.cards[:, 12] != 4]
    assert 0.75 < leaves[:, 2].min() < leaves[:, 2].max() < 2.1


def test_no_leaves_in_winter() -> None:
    assert np.all(chunks(Trellis.ROOF, Season.DORMANT).cards[:, 12] == 4)
