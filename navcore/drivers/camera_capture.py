"""A thread that keeps a camera open and holds its newest picture."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass, field

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.geometry.intrinsics import intrinsics_of
from navcore.geometry.lens import Lens
from navcore.geometry.pinhole import PinholeCamera, robot_camera

Image = NDArray[np.uint8]

RECONNECT_S = 1.0
MS = 1_000_000
# A stamp of the driver further back than this is not of the monotonic clock.
OLDEST_STAMP_NS = 500 * MS


@dataclass(frozen=True, slots=True, kw_only=True)
class CameraParams:
    """One camera of the robot.

    Attributes:
        source: /dev/video0, an rtsp:// or http:// address, or a video file, which is played again and again; empty
            for none.
        mount: intrinsics of the picture without distortion, and where the camera sits.
        distortion: k1, k2, p1, p2, k3 of the lens (OpenCV's model), 0 for none.
        latency_ms: from the middle of the exposure until the picture is here, used where the driver does not tell
            when it was taken; 0 to 500.
    """

    source: str = ""
    mount: PinholeCamera = field(default_factory=robot_camera)
    distortion: tuple[float, float, float, float, float] = (0.0, 0.0, 0.0, 0.0, 0.0)
    latency_ms: float = 40.0

    @property
    def lens(self) -> Lens:
        """What bends its pictures. Raises NotFiniteError for a coefficient that is NaN."""
        k1, k2, p1, p2, k3 = self.distortion
        return Lens(k1=k1, k2=k2, p1=p1, p2=p2, k3=k3)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Picture:
    """A picture (H, W, 3), BGR, and the monotonic time of its exposure."""

    image: Image
    stamp_ns: int


class CameraCapture:
    """Reads until stopped; a camera that is lost is opened again every second. `problem` says what is wrong."""

    def __init__(self, params: CameraParams, clock: Callable[[], int]) -> None:
        """`clock`: monotonic time, ns."""
        self._params, self._clock = params, clock
        self._straighten = rectification(params)
        self._newest: Picture | None = None
        self._raw: Picture | None = None
        self._arrived = threading.Condition()
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, name="camera", daemon=True)
        self.problem = "not connected yet"

    def start(self) -> None:
        """Begin to read."""
        self._thread.start()

    def stop(self) -> None:
        """End the thread and close the camera."""
        self._stopping.set()
        self._thread.join()

    def newest(self, after_ns: int, timeout_s: float) -> Picture | None:
        """The newest picture, without distortion, waiting for one exposed after that; None if none comes in time."""
        with self._arrived:
            self._arrived.wait_for(lambda: self._newest is not None and self._newest.stamp_ns > after_ns, timeout_s)
            picture = self._newest
        if picture is None or picture.stamp_ns <= after_ns:
            return None
        return Picture(image=self._straighten(picture.image), stamp_ns=picture.stamp_ns)

    def raw(self, after_ns: int, timeout_s: float) -> Picture | None:
        """As `newest`, as the lens bends it and of whatever size the camera gives: to calibrate it by."""
        with self._arrived:
            self._arrived.wait_for(lambda: self._raw is not None and self._raw.stamp_ns > after_ns, timeout_s)
            picture = self._raw
        return picture if picture is not None and picture.stamp_ns > after_ns else None

    def _run(self) -> None:
        while not self._stopping.is_set():
            camera = open_camera(self._params)
            try:
                self.problem = self._read(camera)
            finally:
                camera.release()
            self._stopping.wait(RECONNECT_S)

    def _read(self, camera: cv2.VideoCapture) -> str:
        """Read until the camera gives nothing more; what is wrong."""
        pause_s = _pause_s(self._params.source, camera)
        while not self._stopping.wait(pause_s):
            given, image = camera.read()
            if not given:
                return f"The camera {self._params.source} gives no picture. Look at its cable and address."
            self.problem = self._wrong_size(image)
            self._hand_out(Picture(image=np.asarray(image, dtype=np.uint8), stamp_ns=self._stamp_ns(camera)))
        return ""

    def _hand_out(self, picture: Picture) -> None:
        """A picture of the wrong size is good for a new calibration only."""
        with self._arrived:
            self._raw = picture
            self._newest = self._newest if self.problem else picture
            self._arrived.notify_all()

    def _wrong_size(self, image: NDArray[np.generic]) -> str:
        (height, width), mount = image.shape[:2], self._params.mount
        if (width, height) == (mount.width_px, mount.height_px):
            return ""
        return (
            f"The camera {self._params.source} gives {width}x{height} pictures, but its calibration is for "
            f"{mount.width_px}x{mount.height_px}. Set the camera's size, or calibrate again."
        )

    def _stamp_ns(self, camera: cv2.VideoCapture) -> int:
        """When the picture was taken: as the kernel tells (V4L2 stamps with the monotonic clock), else estimated."""
        now_ns = self._clock()
        told_ns = int(camera.get(cv2.CAP_PROP_POS_MSEC) * MS)
        if self._params.source.startswith("/dev/") and 0 <= now_ns - told_ns < OLDEST_STAMP_NS:
            return told_ns
        return now_ns - int(self._params.latency_ms * MS)


def open_camera(params: CameraParams) -> cv2.VideoCapture:
    """The camera, asked for the calibration's size and for as little buffering as it has."""
    camera = cv2.VideoCapture(params.source)
    camera.set(cv2.CAP_PROP_FRAME_WIDTH, params.mount.width_px)
    camera.set(cv2.CAP_PROP_FRAME_HEIGHT, params.mount.height_px)
    camera.set(cv2.CAP_PROP_BUFFERSIZE, 1)
    return camera


def rectification(params: CameraParams) -> Callable[[Image], Image]:
    """Removes the lens distortion of a picture; hands it on as it is where there is none."""
    lens = params.lens
    if not lens.bends:
        return lambda image: image
    camera = intrinsics_of(params.mount)
    map_u, map_v = cv2.initUndistortRectifyMap(
        camera.K, np.array(lens.coefficients), np.eye(3), camera.K, camera.size, cv2.CV_16SC2
    )  # fmt: skip
    return lambda image: np.asarray(cv2.remap(image, map_u, map_v, cv2.INTER_LINEAR), dtype=np.uint8)


def _pause_s(source: str, camera: cv2.VideoCapture) -> float:
    """Between two pictures of a file, s: as long as when it was recorded. A camera sets its own pace."""
    if source.startswith("/dev/") or "://" in source:
        return 0.0
    rate = camera.get(cv2.CAP_PROP_FPS)
    return 1.0 / rate if 0.5 < rate < 240.0 else 0.1
