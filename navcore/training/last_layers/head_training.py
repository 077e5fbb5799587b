"""The head of a `FootNet` trained on hot cells; what lies under it stays as it is."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import torch
from torch import Tensor, nn

from navcore.errors import ModelError
from navcore.training.last_layers.hot_cells import HotCells, hot_cells
from navcore.training.loss import LossParams, box_loss, focal_loss
from navcore.training.model import INPUT_HEIGHT_PX, INPUT_WIDTH_PX, FootNet
from navcore.training.pictures import Pictures
from navcore.training.samples import Sample
from navcore.training.start import Start

Progress = Callable[[str], None]
WARM_UP = 0.05
DECAY = 1e-4
# Pictures on which folded norms learn what is usual.
SETTLED_ON = 16


@dataclass(frozen=True, slots=True, kw_only=True)
class HeadParams:
    """Attributes:
    boxes_only: feet stay as they are, to the bit: only what no foot hangs on learns, the boxes and spare channels.
    epochs: passes over the cells.
    batch: cells a step.
    rate: the highest learning rate of the course.
    seed: of the choice and order of cells.
    """

    boxes_only: bool = False
    epochs: int = 8
    batch: int = 8192
    rate: float = 4e-3
    seed: int = 1
    threads: int = 1
    loss: LossParams = LossParams()


def train_head(start: Start, samples: Sequence[Sample], folder: Path, params: HeadParams, progress: Progress) -> Path:
    """Train the layers that tell feet and boxes, nothing else; the path of the weights, `folder`/best.pt.

    Takes a quarter of a megabyte of memory per picture. Raises ModelError for a network that is not ours.
    """
    torch.manual_seed(params.seed)
    torch.set_num_threads(params.threads)
    net = start.architecture.net()
    if not isinstance(net, FootNet):
        raise ModelError("Only our own networks can have their last layers trained; leave --head-only out.")
    pictures = Pictures(samples, INPUT_HEIGHT_PX, INPUT_WIDTH_PX, torch.device("cpu"), params.threads)
    start.begin(net, _some(pictures))
    cells = hot_cells(net, pictures, params.seed, progress)
    progress(f"{len(cells)} cells")
    with _on_patches(net):
        _descend(net, cells, params, progress)
    folder.mkdir(parents=True, exist_ok=True)
    torch.save({"net": net.state_dict(), "architecture": start.architecture.told()}, folder / "best.pt")
    return folder / "best.pt"


def _some(pictures: Pictures) -> Tensor:
    """A few, evenly drawn, that norms may learn from what is usual."""
    images, _ = pictures.batch([round(i * (len(pictures) - 1) / (SETTLED_ON - 1)) for i in range(SETTLED_ON)])
    return images.float() / 255.0


@contextmanager
def _on_patches(net: FootNet) -> Iterator[None]:
    """The head sees what is about one cell, and norms go by what is usual in pictures, not in hot cells."""
    net.eval()
    looking = [m for m in net.head.modules() if isinstance(m, nn.Conv2d) and m.kernel_size == (3, 3)]
    padding = [m.padding for m in looking]
    for module in looking:
        module.padding = (0, 0)
    try:
        yield
    finally:
        for module, before in zip(looking, padding, strict=True):
            module.padding = before


def _descend(net: FootNet, cells: HotCells, params: HeadParams, progress: Progress) -> None:
    learning = [*net.head.parameters(), *net.logits.parameters(), *net.boxes.parameters()]
    if params.boxes_only:
        learning = [*_spare(net), *net.boxes.parameters()]
    optimizer = torch.optim.AdamW(learning, lr=params.rate, weight_decay=0.0 if params.boxes_only else DECAY)
    rng = torch.Generator().manual_seed(params.seed)
    steps = math.ceil(len(cells) / params.batch)
    for epoch in range(params.epochs):
        total = 0.0
        order = torch.randperm(len(cells), generator=rng)
        for step in range(steps):
            chosen = order[step * params.batch : (step + 1) * params.batch]
            optimizer.param_groups[0]["lr"] = params.rate * _course((epoch + step / steps) / params.epochs)
            value = _loss(net, cells.chosen(chosen), params.loss)
            optimizer.zero_grad(set_to_none=True)
            value.backward()  # type: ignore[no-untyped-call]
            torch.nn.utils.clip_grad_norm_(learning, 10.0)
            optimizer.step()
            total += float(value.detach())
        progress(f"epoch {epoch + 1}  loss {total / steps:.3f}")


def _spare(net: FootNet) -> list[nn.Parameter]:
    """Those of the head's last convolution and norm, with no gradient in channels that a foot hangs on."""
    free = (net.logits.weight == 0).flatten(2).all(dim=2).all(dim=0)
    last = [m for m in net.head.modules() if isinstance(m, nn.Conv2d)][-1]
    norm = [m for m in net.head.modules() if isinstance(m, nn.BatchNorm2d)][-1]
    for values in (parameters := [*last.parameters(), *norm.parameters()]):
        values.register_hook(lambda gradient: gradient * free.view(-1, *[1] * (gradient.dim() - 1)))  # type: ignore[no-untyped-call]
    return parameters


def _course(fraction: float) -> float:
    """Factor on the highest learning rate: up in a line, down along a cosine."""
    if fraction < WARM_UP:
        return fraction / WARM_UP
    return 0.5 + 0.5 * math.cos(math.pi * (fraction - WARM_UP) / (1.0 - WARM_UP))


def _loss(net: FootNet, cells: HotCells, params: LossParams) -> Tensor:
    """As of whole pictures."""
    logits, boxes = net.told(cells.under)
    where = focal_loss(logits, cells.heat, params, cells.stands_for[:, None, None, None])
    near = (cells.weight > 0).any(dim=1)
    wanted, weight = cells.boxes[near][..., None, None], cells.weight[near][..., None, None]
    return where + box_loss(boxes[near].view_as(wanted), wanted, weight, params)
