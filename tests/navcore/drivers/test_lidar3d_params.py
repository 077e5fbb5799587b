"""A 3D LiDAR in a robot's settings, and what is refused of them in words."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from navcore.config import RobotConfig, config_from_tree, config_to_tree, load_config
from navcore.drivers.lidar3d.lidar3d_params import Lidar3dParams
from navcore.drivers.lidar3d.models import C16, C16_FINE, VLP16
from navcore.errors import ConfigError


def test_a_robot_has_none_unless_its_settings_name_one() -> None:
    assert RobotConfig().lidar3d.model == ""
    assert config_from_tree(config_to_tree(RobotConfig())).lidar3d == RobotConfig().lidar3d


def test_the_settings_of_the_readme_are_read(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    path.write_text(
        '[lidar3d]\nmodel = "c16"\nsender = "192.168.1.200"\nmount = { x = 0.0, y = 0.0, z = 1.2, pitch = 0.02 }\n'
    )
    params = load_config(path).lidar3d
    assert params.lidar_model() == C16
    assert params.ports() == (2369, 2368)
    assert params.T_base_lidar().t == pytest.approx((0.0, 0.0, 1.2))
    assert params.T_base_lidar().rpy() == pytest.approx((0.0, 0.02, 0.0))


def test_unit_lever_and_nearest_distance_may_be_set() -> None:
    model = Lidar3dParams(model="c16-fine", unit_mm=4.0, lever=0.0, nearest=0.6).lidar_model()
    assert (model.unit, model.lever, model.nearest) == pytest.approx((0.004, 0.0, 0.6))
    assert model.vertical_deg == C16_FINE.vertical_deg
    assert Lidar3dParams(model="vlp16", device_port=0).ports() == (2368,)
    assert Lidar3dParams(model="vlp16").lidar_model() == VLP16


@pytest.mark.parametrize(
    ("settings", "says"),
    [
        ({"model": "c32"}, "model must be vlp16, c16, c16-fine, but is 'c32'"),
        ({"listen": "eth0"}, "listen must be an address like 192.168.1.102, but is 'eth0'"),
        ({"sender": "lidar.local"}, "sender must be an address, but is 'lidar.local'"),
        ({"port": 0}, "port must be 1 to 65535, but is 0"),
        ({"port": 70_000}, "port must be 1 to 65535, but is 70000"),
        ({"device_port": -1}, "device_port must be 0 to 65535, but is -1"),
        ({"unit_mm": 25.0}, "unit_mm must be 0.5 to 10 mm, but is 25.0"),
        ({"lever": math.nan}, "lever must be 0 to 0.1 m, but is nan"),
        ({"nearest": -1.0}, "nearest must be 0 to 5 m, but is -1.0"),
        ({"silent_s": 0.0}, "silent_s must be 0.2 to 60 s, but is 0.0"),
        ({"mount": {"x": 0.0, "y": 0.0, "z": 120.0}}, "mount must lie within 5 m and turn by numbers"),
        ({"mount": {"x": 0.0, "y": 0.0, "z": 1.0, "yaw": math.inf}}, "mount must lie within 5 m and turn by numbers"),
        ({"turns": {"most_lost": 1.0}}, "most_lost must be 0 to 0.9, but is 1.0"),
        ({"turns": {"clock": {"silent_s": 2.0}}}, "A value of PacketClockParams is out of its bounds"),
        ({"prot": 2368}, "Unknown setting 'lidar3d.prot'"),
        ({"model": 16}, "Expected `str`"),
    ],
)
def test_what_cannot_be_is_refused_in_words(settings: dict[str, object], says: str) -> None:
    with pytest.raises(ConfigError) as refused:
        config_from_tree({"lidar3d": settings})
    assert says in str(refused.value)
