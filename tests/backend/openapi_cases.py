"""Requests made of the station's own OpenAPI document: in the expected form, and with one thing wrong somewhere."""

from __future__ import annotations

import copy
import json
import math
import re
from collections.abc import Iterator
from typing import Any, NamedTuple

from hypothesis import strategies as st

from backend.main import bare_app

DOCUMENT: dict[str, Any] = bare_app().openapi()
WRONG_NUMBERS = (math.nan, math.inf, -math.inf, 1e308, -1e308, 1e-320, -1, 0, 2**63, 2**64, 10**30)
WRONG_TEXTS = ("", "NaN", "\0", "\ud800", "../../etc/passwd", "'; DROP TABLE site; --", "<script>", "x" * 5000)
WRONG: tuple[Any, ...] = (*WRONG_NUMBERS, *WRONG_TEXTS, None, True, [], {}, [[]], {"": None}, [math.nan] * 3)
WRONG_PARTS = ("0" * 16, "..%2f", "%00", "-1", "nan", "1e9", "%ff", "a" * 300, "9" * 30)  # of a path
Json = Any
Place = tuple[str | int, ...]


class Operation(NamedTuple):
    """A method on a path."""

    method: str
    path: str
    told: dict[str, Any]

    def parameters(self, where: str) -> list[dict[str, Any]]:
        return [p for p in self.told.get("parameters", []) if p["in"] == where]

    @property
    def body_schema(self) -> dict[str, Any] | None:
        content = self.told.get("requestBody", {}).get("content", {})
        schema: dict[str, Any] | None = content.get("application/json", {}).get("schema")
        return schema


class Case(NamedTuple):
    """One request. `body` None: without one."""

    path: str
    query: dict[str, str]
    body: str | None


def operations() -> Iterator[Operation]:
    """All of the document, apart from those that end the browser's own login or begin one."""
    for path, methods in DOCUMENT["paths"].items():
        if path not in ("/enter", "/api/session/logout"):
            yield from (Operation(method, path, told) for method, told in methods.items())


def values(schema: dict[str, Any], depth: int = 0) -> st.SearchStrategy[Json]:
    """What a schema allows, in small."""
    if "$ref" in schema:
        return values(DOCUMENT["components"]["schemas"][schema["$ref"].rpartition("/")[2]], depth)
    if "enum" in schema or "const" in schema:
        return st.sampled_from(schema.get("enum") or [schema["const"]])
    if "anyOf" in schema:
        return st.one_of([values(choice, depth) for choice in schema["anyOf"]])
    return _of_type(schema, depth)


def _of_type(schema: dict[str, Any], depth: int) -> st.SearchStrategy[Json]:
    match schema.get("type"):
        case "object":
            return _objects(schema, depth + 1)
        case "array":
            return _arrays(schema, depth + 1)
        case "number":
            return st.floats(-200.0, 200.0)
        case "integer":
            return st.integers(schema.get("minimum", -10), schema.get("maximum", 10))
        case "string":
            return st.from_regex(schema["pattern"], fullmatch=True) if "pattern" in schema else st.text(max_size=8)
        case "boolean":
            return st.booleans()
    return st.none() | st.integers() | st.text(max_size=3)


def _objects(schema: dict[str, Any], depth: int) -> st.SearchStrategy[Json]:
    named, required = schema.get("properties", {}), set(schema.get("required", ()))
    parts = {name: values(part, depth) for name, part in named.items()}
    optional = {name: part for name, part in parts.items() if name not in required}
    return st.fixed_dictionaries({name: parts[name] for name in required}, optional=optional)


def _arrays(schema: dict[str, Any], depth: int) -> st.SearchStrategy[Json]:
    if "prefixItems" in schema:
        return st.tuples(*(values(item, depth) for item in schema["prefixItems"])).map(list)
    return st.lists(values(schema.get("items", {}), depth), max_size=3 if depth < 5 else 4)


def places(value: Json, place: Place = ()) -> list[Place]:
    """Where something could be put in its stead: everywhere."""
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [place, *(found for key, item in inner for found in places(item, (*place, key)))]


def with_wrong(value: Json, place: Place, wrong: Json) -> Json:
    """A copy with something else at that place."""
    if not place:
        return wrong
    changed = copy.deepcopy(value)
    at = changed
    for key in place[:-1]:
        at = at[key]
    at[place[-1]] = wrong
    return changed


@st.composite
def bodies(draw: st.DrawFn, schema: dict[str, Any]) -> str:
    """JSON text of what the schema allows, usually with one wrong thing in it."""
    value = draw(values(schema))
    if draw(st.integers(0, 3)):
        value = with_wrong(value, draw(st.sampled_from(places(value))), draw(st.sampled_from(WRONG)))
    return json.dumps(value)


@st.composite
def cases(draw: st.DrawFn, operation: Operation, known: dict[str, str]) -> Case:
    """A request; `known` are the ids of things that are there."""
    path = operation.path
    for parameter in operation.parameters("path"):
        name = parameter["name"]
        there = st.just(known[name]) if name in known else values(parameter["schema"])
        path = path.replace(f"{{{name}}}", str(draw(there | st.sampled_from(WRONG_PARTS))))
    texts = st.sampled_from([str(wrong).encode(errors="ignore").decode() for wrong in WRONG])
    query = {p["name"]: draw(values(p["schema"]).map(str) | texts) for p in operation.parameters("query")}
    schema = operation.body_schema
    return Case(re.sub(r"[\r\n]", "", path), query, None if schema is None else draw(bodies(schema)))
