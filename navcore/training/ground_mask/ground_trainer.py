"""Training of the ground's net: so many passes on one core, repeatable from its seed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

from navcore.errors import InputError
from navcore.perception.published_fusion.ground_segmenter import blob
from navcore.training.budget import Budget
from navcore.training.ground_mask.ground_net import GroundNet, GroundNetParams
from navcore.training.ground_mask.ground_pictures import GroundPictures
from navcore.training.running_mean import RunningMean

Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundTrainerParams:
    """How long and how fast.

    Attributes:
        epochs: passes over the pictures, >= 1. batch: pictures per step, >= 1.
        learning_rate: the highest of its course. average: decay of the running mean of the weights per step.
        brightness: pictures are made so much darker or brighter at random, share.
        seed: of weights, order and augmentation. threads: of torch.
    """

    epochs: int = 14
    batch: int = 16
    learning_rate: float = 4e-3
    weight_decay: float = 1e-3
    average: float = 0.99
    brightness: float = 0.25
    seed: int = 1
    threads: int = 1
    net: GroundNetParams = GroundNetParams()

    def __post_init__(self) -> None:
        if self.epochs < 1 or self.batch < 1:
            raise InputError("Training needs one pass and one picture per step or more.")


def train_ground(
    training: GroundPictures, validation: GroundPictures, params: GroundTrainerParams, report: Callable[[str], None]
) -> nn.Module:
    """The trained net, ready to be asked; `report` is told loss and IoU after every pass."""
    torch.manual_seed(params.seed)
    torch.set_num_threads(params.threads)
    net, rng = GroundNet(params.net), np.random.default_rng((params.seed, 41))
    mean = RunningMean(net, params.average)
    optimizer = torch.optim.AdamW(net.parameters(), lr=params.learning_rate, weight_decay=params.weight_decay)
    budget = Budget(steps=params.epochs * max(1, len(training.squares) // params.batch), minutes=None)
    for epoch in range(params.epochs):
        losses = []
        for chosen in _batches(len(training.squares), params.batch, rng):
            for group in optimizer.param_groups:
                group["lr"] = params.learning_rate * budget.course()
            losses.append(_step(net, optimizer, *_augmented(training, chosen, params.brightness, rng)))
            mean.follow(net)
            budget.step()
        scored = mean_iou(net_masks(mean.net, validation), validation.masks)
        report(f"pass {epoch + 1} of {params.epochs}: loss {np.mean(losses):.3f}, IoU {scored:.3f} on held-out ones")
    return mean.net


def net_masks(net: nn.Module, pictures: GroundPictures) -> Mask:
    """What the net takes for ground, (N, S, S)."""
    with torch.no_grad():
        logits = (net(torch.from_numpy(blob(square))[None])[0, 0] for square in pictures.squares)
        return np.array([(told > 0.0).numpy() for told in logits])


def mean_iou(found: Mask, true: Mask) -> float:
    """Intersection over union, mean of all pictures (N, S, S); a picture without ground counts 1 if none is found."""
    both, either = (found & true).sum(axis=(1, 2)), (found | true).sum(axis=(1, 2))
    return float(np.mean(np.where(either > 0, both / np.maximum(either, 1), 1.0)))


def _batches(count: int, batch: int, rng: np.random.Generator) -> list[NDArray[np.int64]]:
    """All pictures in random order; the few that fill no batch are left out of this pass."""
    order = rng.permutation(count)
    return [order[k : k + batch] for k in range(0, max(count - batch, 0) + 1, batch)]


def _augmented(
    pictures: GroundPictures, chosen: NDArray[np.int64], brightness: float, rng: np.random.Generator
) -> tuple[Tensor, Tensor]:
    """(B, 3, S, S) and (B, 1, S, S): half of them mirrored, each brighter or darker."""
    images = np.array([blob(square) for square in pictures.squares[chosen]])
    masks = pictures.masks[chosen][:, None].astype(np.float32)
    mirrored = rng.random(len(chosen)) < 0.5
    images[mirrored], masks[mirrored] = images[mirrored, ..., ::-1], masks[mirrored, ..., ::-1]
    images *= np.exp(rng.uniform(-brightness, brightness, (len(chosen), 1, 1, 1))).astype(np.float32)
    return torch.from_numpy(np.minimum(images, 1.0)), torch.from_numpy(masks)


def _step(net: nn.Module, optimizer: torch.optim.Optimizer, images: Tensor, masks: Tensor) -> float:
    net.train()
    loss = torch.nn.functional.binary_cross_entropy_with_logits(net(images), masks)
    optimizer.zero_grad(set_to_none=True)
    loss.backward()  # type: ignore[no-untyped-call]
    optimizer.step()
    return float(loss.detach())
