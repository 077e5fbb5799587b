"""An operator's word of where the robot stands, on its way to the navigator."""

from __future__ import annotations

import secrets

from backend.audit import AuditBook
from backend.errors import RefusedError
from backend.logins import Login
from backend.navigator import NavigatorClient
from backend.robot import RobotView
from backend.schemas import RobotPlace
from backend.sites import SiteStore
from navcore.messages import Request, RequestKind, ToldPlace

CANNOT_PLACE = "The robot cannot be told where it stands."
OTHER_FARM = "The robot is set up for another farm. Open that farm on Drive."


class Placer:
    """What stands against it is the navigator's to say: it knows whether the robot stands, and what GNSS tells."""

    def __init__(self, sites: SiteStore, robot: RobotView, navigator: NavigatorClient, audit: AuditBook) -> None:
        self._sites, self._robot, self._navigator, self._audit = sites, robot, navigator, audit

    def place(self, login: Login, told: RobotPlace) -> None:
        """Raises RefusedError with every reason, NotFoundError for a farm that is not there."""
        reasons = self._ask(told)
        self._audit.write(
            login, "stands at", f"{told.x:.1f} {told.y:.1f}", "refused: " + " ".join(reasons) if reasons else "done"
        )
        if reasons:
            raise RefusedError(CANNOT_PLACE, reasons)

    def _ask(self, told: RobotPlace) -> tuple[str, ...]:
        datum = self._sites.get(told.site_id).site.datum
        if self._robot.describe().site_id not in (None, told.site_id):
            return (OTHER_FARM,)
        place = ToldPlace(x=told.x, y=told.y, yaw=told.yaw, datum=(datum.lat_deg, datum.lon_deg, datum.height_m))
        request = Request(kind=RequestKind.PLACE, request_id=secrets.token_hex(8), place=place)
        reply = self._navigator.ask(request)
        return () if reply.accepted else reply.reasons
