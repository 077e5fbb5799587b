"""Labelled pictures as tensors, fitted to the network's input as the robot does it."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from navcore.perception.picture_fit import fit_picture
from navcore.training.samples import Labels, Sample


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BatchLabels:
    """What is in each of B pictures, filled up to the longest list, M objects.

    Attributes:
        boxes: (B, M, 4) x1, y1, x2, y2, pixels; y2 is where the object meets the ground.
        kinds: (B, M) index into `KINDS`.
        asked: (B, M) counts; found or missed.
        ignored: (B, M) is there, but neither as found nor as missed. Neither: no object.
    """

    boxes: Tensor
    kinds: Tensor
    asked: Tensor
    ignored: Tensor

    def chosen(self, indices: Tensor) -> BatchLabels:
        """Those of the pictures (B,) int64 alone."""
        return BatchLabels(
            boxes=self.boxes[indices], kinds=self.kinds[indices], asked=self.asked[indices],
            ignored=self.ignored[indices],
        )  # fmt: skip


def stack_labels(labels: Sequence[Labels], scales: Sequence[float], device: torch.device) -> BatchLabels:
    """Labels of pictures that are shown `scales` times as large."""
    count, longest = len(labels), max([1, *(len(one.boxes) for one in labels)])
    boxes, kinds = np.zeros((count, longest, 4), dtype=np.float32), np.zeros((count, longest), dtype=np.int64)
    there, ignore = np.zeros((2, count, longest), dtype=np.bool_)
    for i, (one, scale) in enumerate(zip(labels, scales, strict=True)):
        n = len(one.boxes)
        boxes[i, :n], kinds[i, :n], there[i, :n], ignore[i, :n] = one.boxes * scale, one.kinds, True, one.ignore
    return BatchLabels(
        boxes=torch.from_numpy(boxes).to(device), kinds=torch.from_numpy(kinds).to(device),
        asked=torch.from_numpy(there & ~ignore).to(device), ignored=torch.from_numpy(ignore).to(device),
    )  # fmt: skip


class Pictures:
    """All pictures of a set. A GPU with room keeps them, so that no epoch reads them again."""

    def __init__(
        self, samples: Sequence[Sample], height_px: int, width_px: int, device: torch.device, threads: int = 1
    ) -> None:
        """Raises InputError for a picture that cannot be read (here on a GPU, else when it is asked for)."""
        self._samples, self._size, self._device = samples, (height_px, width_px), device
        self._threads = ThreadPoolExecutor(threads)
        self._labels: BatchLabels | None = None
        self._kept = self._keep() if self._fits() else None

    def __len__(self) -> int:
        return len(self._samples)

    def batch(self, indices: Sequence[int]) -> tuple[Tensor, BatchLabels]:
        """Pictures (B, 3, H, W) uint8, BGR, in the upper left corner, and their labels."""
        if self._kept is not None and self._labels is not None:
            chosen = torch.as_tensor(list(indices), dtype=torch.int64, device=self._device)
            return self._kept[chosen], self._labels.chosen(chosen)
        samples = [self._samples[i] for i in indices]
        shown = list(self._threads.map(self._fitted, samples))
        labels = stack_labels([s.labels for s in samples], [scale for _, scale in shown], self._device)
        return _tensor([image for image, _ in shown]).to(self._device), labels

    def _fits(self) -> bool:
        """Whether the pictures take less than half of the free memory of a GPU."""
        if self._device.type != "cuda":
            return False
        free, _ = torch.cuda.mem_get_info(self._device)
        return len(self._samples) * 3 * self._size[0] * self._size[1] < free / 2

    def _keep(self) -> Tensor:
        kept = torch.empty((len(self), 3, *self._size), dtype=torch.uint8, device=self._device)
        scales = []
        for i, (image, scale) in enumerate(self._threads.map(self._fitted, self._samples)):
            kept[i] = _tensor([image])[0].to(self._device)
            scales.append(scale)
        self._labels = stack_labels([s.labels for s in self._samples], scales, self._device)
        return kept

    def _fitted(self, sample: Sample) -> tuple[NDArray[np.uint8], float]:
        """A picture of the network's size, and how many times as large it is shown."""
        shown, scale = fit_picture(sample.image(), *self._size)
        full = np.zeros((*self._size, 3), dtype=np.uint8)
        full[: shown.shape[0], : shown.shape[1]] = shown
        return full, scale


def _tensor(images: Sequence[NDArray[np.uint8]]) -> Tensor:
    return torch.from_numpy(np.stack(images)).permute(0, 3, 1, 2).contiguous()
