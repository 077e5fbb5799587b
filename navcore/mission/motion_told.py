"""How the robot moves, told to those who match clouds on a map in another process."""

from __future__ import annotations

from navcore.messages import Odometry
from navcore.mission.senses import Senses


def odometry(senses: Senses, now_ns: int) -> Odometry:
    """Pose in `odom`, velocity, attitude, and the filter's pose and an operator's word to start from."""
    at, pose, attitude = senses.T_odom_base, senses.pose, senses.attitude
    return Odometry(
        stamp_ns=now_ns,
        x=at.x,
        y=at.y,
        yaw=at.yaw,
        v=pose.v if pose else 0.0,
        omega=pose.omega if pose else 0.0,
        roll=attitude.roll,
        pitch=attitude.pitch,
        pose=pose,
        quality=senses.gnss_quality,
        told=senses.placing.estimate(now_ns, at),
        told_ns=senses.placing.told_ns,
    )
