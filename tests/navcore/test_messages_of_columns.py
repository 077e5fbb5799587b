"""Messages made of columns are those that would have been made one by one."""

from __future__ import annotations

import dataclasses

import pytest

from navcore.messages import ScannedPlant
from navcore.messages.columns import made_of_columns


def test_a_message_of_columns_is_the_one_made_by_itself() -> None:
    made = made_of_columns(ScannedPlant, [3, 5], [1.0, 2.0], [0.5, -0.5], [0.1, 0.2], [0.9, 0.4], [1, 0], [None, 7])
    first = ScannedPlant(number=3, x=1.0, y=0.5, diameter=0.1, sureness=0.9, side=1)
    second = ScannedPlant(number=5, x=2.0, y=-0.5, diameter=0.2, sureness=0.4, side=0, object=7)
    assert made == (first, second)
    assert hash(made[1]) == hash(second)
    with pytest.raises(dataclasses.FrozenInstanceError):
        made[0].x = 2.0  # type: ignore[misc]


def test_columns_that_do_not_belong_together_make_nothing() -> None:
    with pytest.raises(ValueError, match="shorter"):
        made_of_columns(ScannedPlant, [3, 5], [1.0], [0.5, 0.5], [0.1, 0.2], [0.9, 0.4], [1, 0], [None, 7])
    with pytest.raises(ValueError, match="shorter"):
        made_of_columns(ScannedPlant, [3], [1.0])
