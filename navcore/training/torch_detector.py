"""The network in torch as a `Detector`, for validation during training."""

from __future__ import annotations

import math

import numpy as np
import torch
from torch import nn

from navcore.messages import DetectedObject
from navcore.perception.box_decoding import DecodingParams, decode, detected_objects
from navcore.perception.detector import Image
from navcore.training.model import peaks


class TorchDetector:
    """Same decoding as the shipped detector; a low threshold, so that the whole precision-recall curve is seen."""

    def __init__(self, net: nn.Module, decoding: DecodingParams = DecodingParams(threshold=0.05)) -> None:
        self._net = net.eval()
        self._decoding = decoding
        self._device = next(net.parameters()).device

    @torch.no_grad()
    def detect(self, image: Image) -> tuple[DetectedObject, ...]:
        """Boxes in a picture (H, W, 3), BGR, at its own size padded to multiples of 32."""
        height, width = image.shape[:2]
        padded = np.zeros((math.ceil(height / 32) * 32, math.ceil(width / 32) * 32, 3), dtype=np.float32)
        padded[:height, :width] = image.astype(np.float32) / 255
        blob = torch.from_numpy(padded).permute(2, 0, 1)[None].contiguous(memory_format=torch.channels_last)
        logits, boxes = (values.cpu() for values in self._net(blob.to(self._device)))
        stride = padded.shape[1] // logits.shape[3]
        found, confidence, kinds = decode(peaks(logits)[0].numpy(), boxes[0].numpy(), stride, self._decoding)
        return detected_objects(found, confidence, kinds, scale=1.0, width_px=width, height_px=height)
