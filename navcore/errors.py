"""The one exception tree of Rowpilot.

    RowpilotError
    ├── InputError              something handed to us is not what it must be
    │   ├── NotFiniteError          NaN or infinity at a border
    │   ├── SiteError               a site map or its GeoJSON is unusable
    │   ├── MissionError            a mission cannot be driven; carries every reason at once
    │   ├── OrthophotoError         a picture that cannot become the site's ground
    │   ├── LogError                a run log or sensor log that cannot be read
    │   ├── SentenceError           a receiver's sentence that is no evidence; counted by its reader
    │   ├── ModelError              a detector file that cannot be used
    │   ├── CloudError              a file of points that cannot be read or written
    │   ├── NdtMapError             an NDT map or its file is unusable
    │   ├── CalibrationError        pictures, scans or a file that no calibration comes of; carries every reason
    │   └── ConfigError             unknown key, value out of bounds
    ├── TransportError          a process of the station does not answer
    └── ContractError           our own code broke a promise; never caught to carry on

Conditions that belong to the field (no fix, no row, not converged) are values with a reason, not exceptions.
"""

from __future__ import annotations

from collections.abc import Iterable


class RowpilotError(Exception):
    """Root of all our exceptions. The text is a sentence that says what to do."""


class InputError(RowpilotError):
    """Something handed to us is not what it must be."""


class NotFiniteError(InputError):
    """A number is NaN or infinite."""


class SiteError(InputError):
    """A site map or its GeoJSON is unusable.

    Attributes:
        reasons: every reason, each a sentence; empty where the text says it all.
    """

    def __init__(self, text: str, reasons: Iterable[str] = ()) -> None:
        self.reasons = tuple(reasons)
        super().__init__(text)


class MissionError(InputError):
    """A mission cannot be driven.

    Attributes:
        reasons: every reason, each a sentence for the operator.
    """

    def __init__(self, reasons: Iterable[str]) -> None:
        self.reasons = tuple(reasons)
        super().__init__(" ".join(self.reasons))


class OrthophotoError(InputError):
    """A picture that cannot become the site's ground."""


class LogError(InputError):
    """A log that cannot be read."""


class SentenceError(InputError):
    """A receiver's sentence is no evidence; the text says why."""


class ModelError(InputError):
    """A detector file that cannot be used."""


class CloudError(InputError):
    """A file of points that cannot be read or written; the text names file and place."""


class NdtMapError(InputError):
    """An NDT map or its file is unusable."""


class CalibrationError(InputError):
    """Pictures, scans or a file that no calibration comes of.

    Attributes:
        reasons: every reason, each a sentence that says what to do.
    """

    def __init__(self, reasons: Iterable[str]) -> None:
        self.reasons = tuple(reasons)
        super().__init__(" ".join(self.reasons))


class ConfigError(InputError):
    """Unknown key or value out of bounds."""


class TransportError(RowpilotError):
    """A process of the station does not answer."""


class ContractError(RowpilotError):
    """Our own code broke a promise."""
