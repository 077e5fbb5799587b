"""Training of the detector: epochs, validation, the best weights kept."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor
from torch.optim.swa_utils import AveragedModel

from navcore.errors import ModelError
from navcore.training.augment import AugmentParams, augment
from navcore.training.evaluate import Scores, evaluate
from navcore.training.loss import LossParams, loss
from navcore.training.model import FootNet, FootNetParams
from navcore.training.samples import Sample
from navcore.training.targets import targets
from navcore.training.torch_detector import TorchDetector

Progress = Callable[[str], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class TrainerParams:
    """How long and how fast.

    Attributes:
        epochs: passes over the training pictures.
        batch: pictures per step.
        learning_rate: the highest of one cycle (Smith 2018).
        average: decay of the running mean of the weights per step, which is what is validated and kept.
        threshold: working threshold of the validation's recall, precision and feet.
        seed: of weights, order and augmentation.
        threads: of torch.
        validation_pictures: every epoch is validated on so many, evenly drawn.
    """

    epochs: int = 24
    batch: int = 12
    learning_rate: float = 4e-3
    weight_decay: float = 1e-3
    average: float = 0.995
    threshold: float = 0.3
    seed: int = 1
    threads: int = 1
    validation_pictures: int = 100
    net: FootNetParams = FootNetParams()
    loss: LossParams = LossParams()
    augment: AugmentParams = AugmentParams()


class Trainer:
    """One training run in `folder`: `last.pt` to go on from, `best.pt` with the best validation so far."""

    def __init__(self, folder: Path, training: Sequence[Sample], validation: Sequence[Sample], params: TrainerParams):
        torch.manual_seed(params.seed)
        torch.set_num_threads(params.threads)
        self._folder, self._training, self._validation, self._params = folder, training, validation, params
        self._net = FootNet(params.net).to(memory_format=torch.channels_last)  # type: ignore[call-overload]
        self._mean = AveragedModel(self._net, avg_fn=running_mean(params.average), use_buffers=True)
        self._optimizer = torch.optim.AdamW(
            self._net.parameters(), lr=params.learning_rate, weight_decay=params.weight_decay
        )
        self._steps = max(1, len(training) // params.batch)
        self._schedule = torch.optim.lr_scheduler.OneCycleLR(
            self._optimizer, params.learning_rate, total_steps=params.epochs * self._steps + 1, pct_start=0.2
        )
        self._epoch, self._best = 0, -1.0
        folder.mkdir(parents=True, exist_ok=True)

    def resume(self) -> None:
        """Go on from `last.pt`. Raises ModelError if it is missing or of another run."""
        try:
            state = torch.load(self._folder / "last.pt", weights_only=True)
            self._net.load_state_dict(state["net"])
            self._mean.load_state_dict(state["mean"])
            self._optimizer.load_state_dict(state["optimizer"])
            self._schedule.load_state_dict(state["schedule"])
            self._epoch, self._best = int(state["epoch"]), float(state["best"])
        except (OSError, KeyError, RuntimeError, ValueError) as error:
            raise ModelError(f"There is no run to resume in {self._folder}; start it without --resume.") from error

    def run(self, progress: Progress) -> Path:
        """Train to the last epoch; the path of the best weights."""
        while self._epoch < self._params.epochs:
            mean_loss = self._train_epoch(progress)
            self._epoch += 1
            scores = self._validate()
            self._keep(scores.map50)
            progress(
                f"epoch {self._epoch}/{self._params.epochs}  loss {mean_loss:.3f}  mAP50 {scores.map50:.3f}  recall "
                f"{scores.feet.recall:.3f}  precision {scores.feet.precision:.3f}  foot "
                f"{scores.feet.median_u_px:.2f}, {scores.feet.median_v_px:.2f} px"
            )
        return self._folder / "best.pt"

    def _train_epoch(self, progress: Progress) -> float:
        rng = np.random.default_rng((self._params.seed, self._epoch))
        order = rng.permutation(len(self._training))
        total = 0.0
        self._net.train()
        for step in range(self._steps):
            chosen = order[step * self._params.batch : (step + 1) * self._params.batch]
            total += self._step([self._training[int(i)] for i in chosen], rng)
            if (step + 1) % 25 == 0:
                progress(f"  step {step + 1}/{self._steps}  loss {total / (step + 1):.3f}")
        return total / self._steps

    def _step(self, samples: Sequence[Sample], rng: np.random.Generator) -> float:
        image, heat, wanted, weight = batch(samples, self._params.augment, rng)
        logits, boxes = self._net(image)
        value = loss(logits, boxes, heat, wanted, weight, self._params.loss)
        self._optimizer.zero_grad(set_to_none=True)
        value.backward()  # type: ignore[no-untyped-call]
        torch.nn.utils.clip_grad_norm_(self._net.parameters(), 10.0)
        self._optimizer.step()
        self._schedule.step()
        self._mean.update_parameters(self._net)
        return float(value.detach())

    def _validate(self) -> Scores:
        every = max(1, len(self._validation) // self._params.validation_pictures)
        return evaluate(TorchDetector(self._mean.module), self._validation[::every], self._params.threshold)[0]

    def _keep(self, map50: float) -> None:
        if map50 > self._best:
            self._best = map50
            net = self._params.net
            shape = {"channels": net.channels, "head": net.head, "map50": map50, "epoch": self._epoch}
            torch.save({"net": self._mean.module.state_dict(), **shape}, self._folder / "best.pt")
        torch.save(self._state(), self._folder / "last.pt")

    def _state(self) -> dict[str, Any]:
        return {
            "net": self._net.state_dict(), "mean": self._mean.state_dict(), "optimizer": self._optimizer.state_dict(),
            "schedule": self._schedule.state_dict(), "epoch": self._epoch, "best": self._best,
        }  # fmt: skip


def running_mean(decay: float) -> Callable[[Tensor, Tensor, Tensor | int], Tensor]:
    """Exponential mean of the weights that forgets the random start quickly: less decay in the first steps."""

    def mean(kept: Tensor, new: Tensor, steps: Tensor | int) -> Tensor:
        if not kept.is_floating_point():
            return new
        n = float(steps)
        return kept.lerp(new, 1.0 - min(decay, (1.0 + n) / (10.0 + n)))

    return mean


def batch(
    samples: Sequence[Sample], params: AugmentParams, rng: np.random.Generator
) -> tuple[Tensor, Tensor, Tensor, Tensor]:
    """Augmented pictures (B, 3, H, W), heat, box values and their weight."""
    images, wanted = [], []
    for sample in samples:
        image, labels = augment(sample.image(), sample.labels, params, rng)
        images.append(image)
        wanted.append(targets(labels, params.height_px, params.width_px))
    stacked = torch.from_numpy(np.stack(images)).permute(0, 3, 1, 2).float() / 255
    heat, boxes = (torch.from_numpy(np.stack(a)) for a in ([t.heat for t in wanted], [t.boxes for t in wanted]))
    return stacked, heat, boxes, torch.from_numpy(np.stack([t.weight for t in wanted]))


def load_net(path: Path) -> FootNet:
    """The network of a `best.pt`, ready to detect. Raises ModelError for anything else."""
    try:
        state = torch.load(path, weights_only=True)
        net = FootNet(FootNetParams(channels=tuple(state["channels"]), head=int(state["head"])))
        net.load_state_dict(state["net"])
    except Exception as error:  # torch raises pickle, zip and runtime errors of all kinds for a broken file
        raise ModelError(f"{path} holds no weights of this detector.") from error
    return net.eval()
