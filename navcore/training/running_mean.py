"""The exponential mean of a network's weights over its training, which is what is validated and kept."""

from __future__ import annotations

import copy

import torch
from torch import Tensor, nn


class RunningMean:
    """It forgets the random start quickly: less decay in the first steps. Never waits for a GPU."""

    def __init__(self, net: nn.Module, decay: float) -> None:
        self.net = copy.deepcopy(net).eval().requires_grad_(False)
        self._decay, self._steps = decay, 0

    def resume(self, weights: dict[str, Tensor], steps: int) -> None:
        """Go on from those weights after so many steps."""
        self.net.load_state_dict(weights)
        self._steps = steps

    @torch.no_grad()
    def follow(self, net: nn.Module) -> None:
        """One more step is done."""
        self._steps += 1
        share = 1.0 - min(self._decay, (1.0 + self._steps) / (10.0 + self._steps))
        kept, new = _numbers(self.net), _numbers(net)
        torch._foreach_lerp_(kept, new, share)
        for own, other in zip(self.net.buffers(), net.buffers(), strict=True):
            if not own.is_floating_point():
                own.copy_(other)


def _numbers(net: nn.Module) -> list[Tensor]:
    """Weights and running statistics."""
    return [t.detach() for t in (*net.parameters(), *net.buffers()) if t.is_floating_point()]
