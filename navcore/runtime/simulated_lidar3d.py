"""The 3D LiDAR of the simulated robot: turns cast from the world's truth, in the process that uses them."""

from __future__ import annotations

from navcore.geometry.lidar_mount import LidarMount
from navcore.maps.site_map import SiteMap
from navcore.messages import SimTruth
from navcore.runtime.simulation import SimulationParams
from navcore.sim.lidar3d import C16, SimTurn
from navcore.sim.lidar3d_feed import Lidar3dFeed
from navcore.sim.trellis.trellised import trellised
from navcore.topics import SIM_TRUTH
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Subscriber
from navcore.vehicle import VehicleParams

# Truths come 50 a second; so many may wait.
_MOST_TRUTHS = 200


class SimulatedLidar3d:
    """Builds the same orchard as the world's process from the same seed: no cloud crosses a process.

    Attributes:
        mount: where the LiDAR sits.
    """

    def __init__(
        self, endpoints: Endpoints, site: SiteMap, vehicle: VehicleParams, params: SimulationParams, mount: LidarMount
    ) -> None:
        world, self.mount = params.world(site, vehicle, 0), mount
        scene = trellised(world.site, world.orchard, world.terrain).scene
        self._feed = Lidar3dFeed(scene, world.terrain, vehicle, self.mount, C16, params.world_seed)
        self._bus = Subscriber(endpoints, (SIM_TRUTH.name,), queue_length=_MOST_TRUTHS)

    def take(self, timeout_ms: int = 0) -> SimTurn | None:
        """The newest turn that is over and was not handed out before, None if there is none.

        Waits so long for a truth if none is there yet.
        """
        received = self._bus.receive(timeout_ms)
        while received is not None:
            self._feed.add(decode(SimTruth, received.payload))
            received = self._bus.receive(0)
        self._feed.skip_to_newest()
        return self._feed.turn()

    def close(self) -> None:
        """Let go of the bus."""
        self._bus.close()
