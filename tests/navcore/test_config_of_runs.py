"""Which controller drives: chosen by name, and in runs of before there was a choice the one that drove them."""

from __future__ import annotations

from typing import Any

import pytest

from navcore.config import RobotConfig, config_from_tree, config_of_run, config_to_tree
from navcore.control.line_tracker import LineTracker
from navcore.control.tracking import TrackerName
from navcore.errors import ConfigError
from navcore.maps.site_map import Datum

DATUM = Datum(lat_deg=45.0, lon_deg=9.0, height_m=100.0)


def name_in(config: RobotConfig) -> TrackerName:
    return config.navigator.driver.tracking.name


def before_the_choice() -> dict[str, Any]:
    tree = config_to_tree(RobotConfig())
    del tree["navigator"]["driver"]["tracking"]
    return tree


def test_a_controller_is_chosen_by_its_name() -> None:
    config = config_from_tree({"navigator": {"driver": {"tracking": {"name": "line"}}}})
    assert isinstance(config.new_navigator(DATUM).driver.controller, LineTracker)


def test_a_controller_that_nobody_knows_is_refused_with_those_that_are_known() -> None:
    with pytest.raises(
        ConfigError, match=r"no 'mpc' for 'navigator.driver.tracking.name'. Known are: published, line"
    ):
        config_from_tree({"navigator": {"driver": {"tracking": {"name": "mpc"}}}})


@pytest.mark.parametrize("name", [7, None, ["lqr"], {}])
def test_a_name_that_is_no_word_is_refused(name: Any) -> None:
    with pytest.raises(ConfigError, match="Known are"):
        config_from_tree({"navigator": {"driver": {"tracking": {"name": name}}}})


def test_a_run_of_before_the_choice_replays_with_the_controller_that_drove_it() -> None:
    assert name_in(config_of_run(before_the_choice())) is TrackerName.LINE
    assert name_in(config_of_run({})) is TrackerName.LINE


@pytest.mark.parametrize("name", list(TrackerName))
def test_a_run_that_knew_the_choice_replays_with_its_own(name: TrackerName) -> None:
    tree = config_to_tree(RobotConfig())
    tree["navigator"]["driver"]["tracking"]["name"] = name.value
    assert name_in(config_of_run(tree)) is name


@pytest.mark.parametrize("tree", [[], 3, {"navigator": 3}, {"navigator": {"driver": []}}])
def test_a_log_with_settings_that_are_none_is_refused(tree: Any) -> None:
    with pytest.raises(ConfigError):
        config_of_run(tree)
