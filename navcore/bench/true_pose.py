"""A robot that knows where it is: the simulator's truth in place of the pose filter, to measure control alone."""

from __future__ import annotations

from navcore.geometry.se2 import SE2
from navcore.messages import NavInputs, PoseEstimate, SimTruth
from navcore.mission.senses import Senses
from navcore.navigator import Navigator
from navcore.sim.world import World, WorldOutput

# 1-sigma that is told, m and rad: well below what anything asks for.
_STD = 0.001


class SeenWorld(World):
    """A world that keeps the truth of its last instant for who asks."""

    truth: SimTruth

    def advance(self, now_ns: int, v: float, omega: float) -> WorldOutput:
        """See `World.advance`."""
        output = super().advance(now_ns, v, omega)
        self.truth = output.truth
        return output


class TrueSenses(Senses):
    """Takes wheels and fixes as ever, and its pose and motion from the world."""

    def __init__(self, real: Senses, world: SeenWorld) -> None:
        super().__init__(real.filter, real.gnss, real.attitude, real.check)
        self._world = world

    def take(self, inputs: NavInputs) -> None:
        """See `Senses.take`."""
        self.chassis = inputs.chassis[-1] if inputs.chassis else self.chassis
        for fix in inputs.gnss:
            self.gnss.add(fix)
        for sample in inputs.imu:
            self.check.add_imu(sample)
        for state in inputs.chassis:
            self.check.add_chassis(state)
        for fix in inputs.gnss:
            self.check.add_gnss(fix)
        at, variance = self._world.truth, _STD**2
        self.T_odom_base = SE2(at.x, at.y, at.yaw)
        self.pose = PoseEstimate(
            stamp_ns=inputs.now_ns, x=at.x, y=at.y, yaw=at.yaw, v=at.v, omega=at.omega,
            covariance=(variance, 0.0, 0.0, 0.0, variance, 0.0, 0.0, 0.0, variance), source="truth",
        )  # fmt: skip
        self.check.add_estimate(self.pose)


def tell_truth(navigator: Navigator, world: SeenWorld) -> None:
    """From now on this navigator knows where it is."""
    navigator.senses = TrueSenses(navigator.senses, world)
