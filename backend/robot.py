"""What the station knows of the robot, and where the simulated one stands."""

from __future__ import annotations

import time

from backend import scene_proxy
from backend.errors import ConflictError
from backend.live import Hub
from backend.schemas import Robot
from backend.settings import Settings
from backend.supervisor import SupervisorClient
from navcore.errors import InputError
from navcore.maps.site_map import SiteMap
from navcore.messages import NavStatus, RunState
from navcore.topics import NAV_STATUS
from navcore.transport.codec import decode
from navcore.vehicle import PROFILES

STANDING = frozenset({RunState.IDLE, RunState.FINISHED, RunState.STOPPED})
STOPPED = "The last mission was stopped. Acknowledge the stop first, or resume the mission."
UNDER_WAY = "A mission is under way. Stop it before you start another."


class RobotView:
    """Read from the newest status; nothing here moves anything."""

    def __init__(self, settings: Settings, hub: Hub, supervisor: SupervisorClient) -> None:
        self._settings = settings
        self._hub = hub
        self._supervisor = supervisor
        self._started_ns = 0

    def status(self) -> NavStatus | None:
        """The navigator's newest status, None if it has been silent for longer than the topic allows."""
        received = self._hub.current().get(NAV_STATUS.name)
        try:
            return decode(NavStatus, received.payload) if received else None
        except InputError:
            return None

    def describe(self) -> Robot:
        """For the browser."""
        status, supervisor = self.status(), self._supervisor.status()
        return Robot(
            connected=status is not None,
            simulated=supervisor.simulated if supervisor else self._settings.simulated,
            vehicle=PROFILES[self._settings.vehicle],
            site_id=supervisor.site_id if supervisor else None,
            state=status.state if status else None,
            run_id=status.run_id if status else None,
            scene=scene_proxy.answers(self._settings.scene_port),
            operators=self._hub.operators(self._settings.operator_timeout_s),
        )

    def start_reasons(self, site_id: str, site_name: str) -> list[str]:
        """What stands against a start on that site, beside the plan and the navigator's own reasons."""
        reasons = []
        status = self.status()
        if status is None:
            reasons.append("The robot is not connected. Check that it is switched on, then try again.")
        elif status.state is RunState.STOPPED:
            reasons.append(STOPPED)
        elif status.state not in STANDING or status.stamp_ns < self._started_ns:
            reasons.append(UNDER_WAY)
        supervisor = self._supervisor.status()
        if supervisor is not None and supervisor.site_id != site_id:
            reasons.append(f"The robot is set up for another farm. Place it on {site_name} first.")
        return reasons

    def require_standing(self, purpose: str) -> None:
        """Raises ConflictError while a mission is under way."""
        status = self.status()
        if status is not None and status.state not in STANDING:
            raise ConflictError(f"A mission is under way. Stop it before you {purpose}.")

    def note_start(self) -> None:
        """A run was started: what the robot said of itself before this is out of date."""
        self._started_ns = time.monotonic_ns()

    def place(self, site_id: str, site: SiteMap) -> None:
        """Set the robot up for a farm; a simulated one starts again there. Raises ConflictError while it drives."""
        self.require_standing("place the robot elsewhere")
        self._supervisor.place(site_id, site)
        self._hub.forget()

    def load_calibration(self) -> None:
        """Have it see by the calibrations that are in use."""
        self._supervisor.load_calibration()
