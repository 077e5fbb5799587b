"""A training run that begins with a detector instead of random weights."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import onnxruntime as ort
import pytest
import torch

from navcore.errors import ModelError
from navcore.perception.onnx_detector import WEIGHTS
from navcore.training.architecture import Architecture
from navcore.training.architecture_choice import named_architecture
from navcore.training.export import export_onnx
from navcore.training.foot_architecture import FootArchitecture
from navcore.training.model import FootNet, FootNetParams
from navcore.training.samples import read_samples
from navcore.training.shipped_weights import read_shipped
from navcore.training.start import start_from
from navcore.training.trainer import Trainer, TrainerParams
from tests.navcore.training.farm_pictures import draw_set

SMALL = FootNetParams(channels=(8, 8, 16, 16, 16), depths=(0, 1, 1, 1), head=16)
FEW = FootArchitecture(params=SMALL)


def pictures(count: int = 8) -> torch.Tensor:
    return torch.from_numpy(np.random.default_rng(5).random((count, 3, 96, 128), dtype=np.float32))


def begun(weights: Path, wanted: Architecture | None = None) -> torch.nn.Module:
    start = start_from(weights, wanted)
    torch.manual_seed(9)
    net = start.architecture.net()
    start.begin(net, pictures())
    return net


def exported(folder: Path, params: FootNetParams) -> tuple[Path, FootNet]:
    """A network that has seen something, and its file."""
    torch.manual_seed(3)
    net = FootNet(params).train()
    for _ in range(3):
        net(pictures())
    export_onnx(net.eval(), folder / "feet.onnx")
    return folder / "feet.onnx", net


def test_a_network_begun_with_the_shipped_file_tells_what_the_file_tells() -> None:
    blob = np.random.default_rng(2).random((1, 3, 384, 640), dtype=np.float32)
    peaks, boxes = ort.InferenceSession(str(WEIGHTS)).run(None, {"image": blob})
    with torch.no_grad():
        logits, own = begun(WEIGHTS).eval()(torch.from_numpy(blob))
    shared = boxes if boxes.shape[1] == 8 else np.tile(boxes, (1, 2, 1, 1))
    np.testing.assert_allclose(own.numpy(), shared, atol=1e-3)
    np.testing.assert_allclose(logits.sigmoid().numpy()[peaks > 0], peaks[peaks > 0], atol=1e-3)


def test_it_tells_the_same_while_it_is_trained_on_the_pictures_it_settled_on() -> None:
    net = begun(WEIGHTS)
    with torch.no_grad():
        still, _ = net.eval()(pictures())
        trained, _ = net.train()(pictures())
    np.testing.assert_allclose(trained.numpy(), still.numpy(), atol=1e-2)


@pytest.mark.parametrize(
    "params", [SMALL, replace(SMALL, separable=False), replace(SMALL, finer=1), replace(SMALL, depths=(1, 0, 2, 1))]
)
def test_the_shape_of_the_network_is_read_from_the_file(tmp_path: Path, params: FootNetParams) -> None:
    path, net = exported(tmp_path, params)
    assert start_from(path, None).architecture == FootArchitecture(params=params)
    with torch.no_grad():
        for own, told in zip(begun(path).eval()(pictures()), net(pictures()), strict=True):
            np.testing.assert_allclose(own.numpy(), told.numpy(), atol=1e-3)


def test_a_wider_network_tells_the_same_at_first(tmp_path: Path) -> None:
    path, net = exported(tmp_path, SMALL)
    wider = FootArchitecture(params=replace(SMALL, channels=(16, 8, 16, 32, 16), head=32))
    with torch.no_grad():
        for own, told in zip(begun(path, wider).eval()(pictures()), net(pictures()), strict=True):
            np.testing.assert_allclose(own.numpy(), told.numpy(), atol=1e-3)


def test_a_narrower_head_keeps_the_channels_that_most_hangs_on(tmp_path: Path) -> None:
    path, net = exported(tmp_path, SMALL)
    idle = [2, 3, 5, 8, 9, 11, 12, 14]
    with torch.no_grad():
        net.logits.weight[:, idle] = net.boxes.weight[:, idle] = 0.0
    export_onnx(net, path)
    narrower = FootArchitecture(params=replace(SMALL, head=8))
    with torch.no_grad():
        for own, told in zip(begun(path, narrower).eval()(pictures()), net(pictures()), strict=True):
            np.testing.assert_allclose(own.numpy(), told.numpy(), atol=1e-3)


def test_finer_feet_begin_with_what_the_coarse_ones_told(tmp_path: Path) -> None:
    path, net = exported(tmp_path, replace(SMALL, finer=1))
    with torch.no_grad():
        fine, _ = begun(path, FootArchitecture(params=SMALL)).eval()(pictures())
        coarse, _ = net(pictures())
    np.testing.assert_allclose(fine.numpy(), coarse.numpy().repeat(2, axis=2).repeat(2, axis=3), atol=1e-3)


def test_a_run_begun_with_good_weights_has_less_to_learn(tmp_path: Path) -> None:
    draw_set(tmp_path / "set", 16, 1)
    samples = read_samples(tmp_path / "set")
    params = TrainerParams(epochs=16, batch=4, learning_rate=1e-2, device="cpu", architecture=FEW)
    anew, again = list[str](), list[str]()
    Trainer(tmp_path / "first", samples, samples[:2], params).run(anew.append)
    for number, weights in enumerate(trained_files(tmp_path / "first")):
        trainer = Trainer(tmp_path / f"again-{number}", samples, samples[:2], replace(params, epochs=1))
        trainer.begin(start_from(weights, None))
        trainer.run(again.append)
    assert max(map(loss_of, again)) < 0.7 * loss_of(anew[0])


def trained_files(run: Path) -> tuple[Path, Path]:
    """What a run has come to in the end, as torch's file and as the robot's."""
    net = FEW.net()
    net.load_state_dict(torch.load(run / "last.pt", weights_only=True)["net"])
    torch.save({"net": net.state_dict(), "architecture": FEW.told()}, run / "end.pt")
    export_onnx(net.eval(), run / "end.onnx")
    return run / "end.pt", run / "end.onnx"


def loss_of(line: str) -> float:
    return float(line.split("loss ")[1].split()[0])


def test_a_file_that_is_no_detector_is_refused(tmp_path: Path) -> None:
    (tmp_path / "feet.onnx").write_bytes(b"no weights")
    with pytest.raises(ModelError, match="no detector of feet"):
        read_shipped(tmp_path / "feet.onnx")
    with pytest.raises(ModelError, match="no detector of feet"):
        read_shipped(WEIGHTS.with_name("ground.onnx"))


def test_a_file_that_is_missing_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match="cannot be read"):
        read_shipped(tmp_path / "none.onnx")


def test_our_weights_are_refused_for_a_published_network() -> None:
    with pytest.raises(ModelError, match="leave --net out"):
        start_from(WEIGHTS, named_architecture("eca"))


def test_trained_weights_are_refused_for_another_network(tmp_path: Path) -> None:
    torch.save({"net": FootNet(SMALL).state_dict(), "architecture": FEW.told()}, tmp_path / "best.pt")
    assert start_from(tmp_path / "best.pt", None).architecture == FEW
    with pytest.raises(ModelError, match="another network"):
        start_from(tmp_path / "best.pt", named_architecture("large"))
