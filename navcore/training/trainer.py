"""Training of a detector: epochs, validation, the best weights kept."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor

from navcore.errors import ModelError
from navcore.training.architecture import Architecture
from navcore.training.augment import AugmentParams, augment
from navcore.training.budget import Budget
from navcore.training.evaluate import Scores, evaluate
from navcore.training.foot_architecture import FootArchitecture
from navcore.training.model import INPUT_HEIGHT_PX, INPUT_WIDTH_PX
from navcore.training.pictures import Pictures
from navcore.training.running_mean import RunningMean
from navcore.training.samples import Sample
from navcore.training.start import Start

Progress = Callable[[str], None]
# Pictures on which folded norms learn what is usual.
SETTLED_ON = 48


@dataclass(frozen=True, slots=True, kw_only=True)
class TrainerParams:
    """How long and how fast.

    Attributes:
        epochs: passes over the training pictures.
        minutes: no longer than so; the learning rate has run its course by then. None: as long as the epochs take.
        batch: pictures per step.
        learning_rate: the highest of the course; None: the architecture's own.
        average: decay of the running mean of the weights per step.
        threshold: working threshold of the validation's recall, precision and feet.
        seed: of weights, order and augmentation.
        device: "cpu", "cuda" (mixed precision), or "auto" for a GPU where there is one.
        threads: of torch and of reading pictures.
        validation_pictures: every epoch is validated on so many, evenly drawn.
        validate_every: share of the run after which the weights are validated, at the end of an epoch.
    """

    epochs: int = 24
    minutes: float | None = None
    batch: int = 12
    learning_rate: float | None = None
    weight_decay: float = 1e-3
    average: float = 0.995
    threshold: float = 0.3
    seed: int = 1
    device: str = "auto"
    threads: int = 1
    validation_pictures: int = 100
    validate_every: float = 0.0
    architecture: Architecture = FootArchitecture()
    augment: AugmentParams = AugmentParams()


class Trainer:
    """One training run in `folder`: `last.pt` to go on from, `best.pt` with the best validation so far."""

    def __init__(self, folder: Path, training: Sequence[Sample], validation: Sequence[Sample], params: TrainerParams):
        torch.manual_seed(params.seed)
        torch.set_num_threads(params.threads)
        self._device = chosen_device(params.device)
        self._folder, self._validation, self._params = folder, validation, params
        self._pictures = Pictures(training, INPUT_HEIGHT_PX, INPUT_WIDTH_PX, self._device, params.threads)
        self._net = params.architecture.net().to(self._device, memory_format=torch.channels_last)  # type: ignore[call-overload]
        self._mean = RunningMean(self._net, params.average)
        self._rate = params.learning_rate or params.architecture.learning_rate
        self._optimizer = torch.optim.AdamW(
            self._net.parameters(), lr=self._rate, weight_decay=params.weight_decay, fused=self._device.type == "cuda"
        )
        self._steps = max(1, len(training) // params.batch)
        self._budget = Budget(steps=params.epochs * self._steps, minutes=params.minutes)
        self._epoch, self._best, self._validated = 0, -1.0, 0.0
        folder.mkdir(parents=True, exist_ok=True)

    def begin(self, start: Start) -> None:
        """Begin with those weights. Raises ModelError for those of another architecture."""
        rng = torch.Generator(self._device).manual_seed(self._params.seed)
        some = np.linspace(0, len(self._pictures) - 1, SETTLED_ON).round().astype(int)
        images, _ = augment(*self._pictures.batch(some.tolist()), self._params.augment, rng)
        start.begin(self._net, images)
        self._mean = RunningMean(self._net, self._params.average)

    def resume(self) -> None:
        """Go on from `last.pt`. Raises ModelError if it is missing or of another run."""
        try:
            state = torch.load(self._folder / "last.pt", weights_only=True, map_location=self._device)
            self._net.load_state_dict(state["net"])
            self._mean.resume(state["mean"], int(state["budget"]["done"]))
            self._optimizer.load_state_dict(state["optimizer"])
            self._budget.resume(**state["budget"])
            self._epoch, self._best = int(state["epoch"]), float(state["best"])
        except (OSError, KeyError, RuntimeError, ValueError, TypeError) as error:
            raise ModelError(f"There is no run to resume in {self._folder}; start it without --resume.") from error

    def run(self, progress: Progress) -> Path:
        """Train to the end of the budget; the path of the best weights."""
        while not self._budget.spent():
            mean_loss = self._train_epoch(progress)
            self._epoch += 1
            told = f"epoch {self._epoch}  loss {mean_loss:.3f}"
            if self._budget.spent() or self._budget.fraction() >= self._validated + self._params.validate_every:
                self._validated = self._budget.fraction()
                told += "  " + self._scored()
            progress(f"{told}  {100 * self._budget.fraction():.0f} % done")
        return self._folder / "best.pt"

    def _scored(self) -> str:
        """Validate and keep; the scores as text."""
        scores = self._validate()
        self._keep(scores.map50)
        feet = scores.feet
        return (
            f"mAP50 {scores.map50:.3f}  recall {feet.recall:.3f}  precision {feet.precision:.3f}  foot "
            f"{feet.median_u_px:.2f}, {feet.median_v_px:.2f} px"
        )

    def _train_epoch(self, progress: Progress) -> float:
        order = np.random.default_rng((self._params.seed, self._epoch)).permutation(len(self._pictures))
        rng = torch.Generator(self._device).manual_seed(1000 * self._params.seed + self._epoch)
        total, done = torch.zeros((), device=self._device), 0
        self._net.train()
        for step in range(self._steps):
            chosen = order[step * self._params.batch : (step + 1) * self._params.batch]
            total += self._step(chosen.tolist(), rng)
            done += 1
            if done % 25 == 0:
                progress(f"  step {done}/{self._steps}  loss {float(total) / done:.3f}")
            if self._budget.spent():
                break
        return float(total) / done

    def _step(self, chosen: Sequence[int], rng: torch.Generator) -> Tensor:
        shape = self._params.augment
        image, labels = augment(*self._pictures.batch(chosen), shape, rng)
        for group in self._optimizer.param_groups:
            group["lr"] = self._rate * self._budget.course()
        with torch.autocast(self._device.type, torch.bfloat16, enabled=self._device.type == "cuda"):
            outputs = self._net(image.contiguous(memory_format=torch.channels_last))
        single = tuple(output.float() for output in outputs)
        value = self._params.architecture.loss(single, labels, shape.height_px, shape.width_px)
        self._optimizer.zero_grad(set_to_none=True)
        value.backward()  # type: ignore[no-untyped-call]
        torch.nn.utils.clip_grad_norm_(self._net.parameters(), 10.0)
        self._optimizer.step()
        self._mean.follow(self._net)
        self._budget.step()
        return value.detach()

    def _validate(self) -> Scores:
        every = max(1, len(self._validation) // self._params.validation_pictures)
        detector = self._params.architecture.detector(self._mean.net)
        return evaluate(detector, self._validation[::every], self._params.threshold)[0]

    def _keep(self, map50: float) -> None:
        if map50 > self._best:
            self._best = map50
            told = {"architecture": self._params.architecture.told(), "map50": map50, "epoch": self._epoch}
            torch.save({"net": self._mean.net.state_dict(), **told}, self._folder / "best.pt")
        torch.save(self._state(), self._folder / "last.pt")

    def _state(self) -> dict[str, Any]:
        return {
            "net": self._net.state_dict(), "mean": self._mean.net.state_dict(),
            "optimizer": self._optimizer.state_dict(), "budget": self._budget.state(), "epoch": self._epoch,
            "best": self._best,
        }  # fmt: skip


def chosen_device(name: str) -> torch.device:
    """The device of that name. Raises ModelError if there is no such one here."""
    if name == "auto":
        name = "cuda" if torch.cuda.is_available() else "cpu"
    if name not in ("cpu", "cuda") or (name == "cuda" and not torch.cuda.is_available()):
        raise ModelError(f"There is no device {name!r} to train on here; leave --device out.")
    return torch.device(name)
