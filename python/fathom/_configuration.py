"""What the classes of fathom.config have in common."""
from __future__ import annotations

import dataclasses
import typing
from collections.abc import Mapping
from typing import Any, TypeVar

Self = TypeVar("Self", bound="Configuration")


@dataclasses.dataclass(slots=True)
class Configuration:
    """An object of a scene file: an attribute for each key. A key that is None is left out, so that what the sensor's
    model or the program says holds. Values are checked when a scene is read, by the rules for scene files."""

    def to_dict(self) -> dict[str, Any]:
        """The object as a scene file has it: all keys that are not None."""
        return {field.name: _plain(getattr(self, field.name)) for field in dataclasses.fields(self)
                if getattr(self, field.name) is not None}

    @classmethod
    def from_dict(cls: type[Self], keys: Mapping[str, Any]) -> Self:
        """The reverse of to_dict: objects within become objects of their own classes."""
        return cls(**{name: _configured(_classes(cls).get(name), value) for name, value in keys.items()})

    def __repr__(self) -> str:
        keys = (f"{field.name}={getattr(self, field.name)!r}" for field in dataclasses.fields(self)
                if getattr(self, field.name) is not None)
        return f"{type(self).__name__}({', '.join(keys)})"


def _plain(value: Any) -> Any:
    if isinstance(value, Configuration):
        return value.to_dict()
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return value


def _configured(of: type[Configuration] | None, value: Any) -> Any:
    if of is None:
        return value
    if isinstance(value, Mapping):
        return of.from_dict(value)
    return [_configured(of, item) for item in value] if isinstance(value, (list, tuple)) else value


def _classes(cls: type) -> dict[str, type[Configuration]]:
    """Of each key that holds an object, or a list of them, its class."""
    found = {}
    for name, hint in typing.get_type_hints(cls).items():
        for part in _parts(hint):
            if isinstance(part, type) and issubclass(part, Configuration):
                found[name] = part
    return found


def _parts(hint: Any) -> list[Any]:
    inner = typing.get_args(hint)
    return [hint] if not inner else [part for one in inner for part in _parts(one)]
