"""The vocabulary has one door: whatever a file of `navcore/messages/` names is found in `navcore.messages`."""

from __future__ import annotations

import ast
from pathlib import Path

from navcore import messages
from navcore.topics import TOPICS

FILES = sorted((Path(__file__).resolve().parents[2] / "navcore" / "messages").glob("[!_]*.py"))


def names_in(file: Path) -> set[str]:
    """Public classes and types that a file defines."""
    body = ast.parse(file.read_text()).body
    classes = [node.name for node in body if isinstance(node, ast.ClassDef)]
    types = [ast.unparse(node.targets[0]) for node in body if isinstance(node, ast.Assign)]
    return {name for name in classes + types if not name.startswith("_")}


def test_every_word_is_found_in_one_place() -> None:
    words = [name for file in FILES for name in sorted(names_in(file))]
    assert sorted(words) == sorted(messages.__all__)


def test_every_exported_word_exists() -> None:
    assert [name for name in messages.__all__ if not hasattr(messages, name)] == []


def test_topics_carry_words_of_the_vocabulary_or_the_chassis_own() -> None:
    homes = {topic.type.__module__ for topic in TOPICS.values()}
    assert {home for home in homes if not home.startswith("navcore.messages.")} == {"navcore.chassis.protocol"}
