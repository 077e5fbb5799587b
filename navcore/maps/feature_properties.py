"""Reading a feature's properties, each with its bounds."""

from __future__ import annotations

from navcore.maps.geojson_features import Problems, ReadFeature, number

# Longest text that is kept, characters.
_LONGEST = 200


class PropertyReader:
    """Takes properties one by one; what nobody took is noted by `finish`."""

    def __init__(self, feature: ReadFeature, problems: Problems) -> None:
        self._feature, self._problems = feature, problems
        self._left = set(feature.properties) - {"id", "kind"}

    def number(self, name: str, default: float, low: float, high: float) -> float:
        """A finite number within [low, high]; the default if it is absent."""
        self._left.discard(name)
        given = self._feature.properties.get(name)
        if given is None:
            return default
        value = number(given)
        if value is None or not low <= value <= high:
            self._problems.add(
                f'"{name}" of {self._feature.label} is {_shown(given)}; it must be a number from {low:g} to {high:g}.'
            )
            return default
        return value

    def text(self, name: str, default: str = "") -> str:
        """A text; the default if it is absent."""
        self._left.discard(name)
        given = self._feature.properties.get(name)
        if given is None:
            return default
        if not isinstance(given, str) or len(given) > _LONGEST:
            self._problems.add(f'"{name}" of {self._feature.label} must be a text of at most {_LONGEST} characters.')
            return default
        return given

    def choice(self, name: str, choices: tuple[str, ...], default: str | None = None) -> str:
        """One of several words; required without a default."""
        self._left.discard(name)
        given = self._feature.properties.get(name, default)
        if given not in choices:
            known = ", ".join(choices)
            self._problems.add(f'"{name}" of {self._feature.label} is {_shown(given)}; it must be one of: {known}.')
            return default or choices[0]
        return str(given)

    def truth(self, name: str, default: bool) -> bool:
        """true or false; the default if it is absent."""
        self._left.discard(name)
        given = self._feature.properties.get(name, default)
        if not isinstance(given, bool):
            self._problems.add(f'"{name}" of {self._feature.label} must be true or false.')
            return default
        return given

    def finish(self) -> None:
        """Note the properties that mean nothing here."""
        if self._left:
            names = ", ".join(sorted(map(str, self._left)))
            self._problems.notes.append(f"Not used of {self._feature.label}: {names}.")


def _shown(value: object) -> str:
    """As written in the file: a number in quotes is a text."""
    return f'the text "{value[:40]}"' if isinstance(value, str) else str(value)[:40]
