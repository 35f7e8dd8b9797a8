# SPDX-License-Identifier: MIT
"""Dictionaries as TOML text, which the compiled part reads and checks."""

import json
from typing import Any, Mapping


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(key)} = {_value(of)}" for key, of in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(one) for one in value) + "]"
    if hasattr(value, "tolist"):  # a number or an array of numpy
        return _value(value.tolist())
    if isinstance(value, (int, float)):
        return repr(value)
    raise TypeError(f"{value!r} cannot stand in a setup or an experiment; give a number, a text, a list or a dictionary")


def _key(key: str) -> str:
    bare = key and all(c.isalnum() and c.isascii() or c in "_-" for c in key)
    return key if bare else json.dumps(key)


def _is_list_of_tables(value: Any) -> bool:
    return isinstance(value, (list, tuple)) and bool(value) and all(isinstance(one, Mapping) for one in value)


def toml_of(table: Mapping[str, Any], path: str = "") -> str:
    """The table as TOML: plain keys first, then tables and lists of tables with their headers."""
    plain = [f"{_key(key)} = {_value(value)}\n" for key, value in table.items()
             if not isinstance(value, Mapping) and not _is_list_of_tables(value)]
    text = "".join(plain)
    for key, value in table.items():
        full = f"{path}.{_key(key)}" if path else _key(key)
        if isinstance(value, Mapping):
            text += f"\n[{full}]\n" + toml_of(value, full)
        elif _is_list_of_tables(value):
            for one in value:
                text += f"\n[[{full}]]\n" + "".join(f"{_key(k)} = {_value(v)}\n" for k, v in one.items())
    return text


def words_of(changes: Mapping[str, Any]) -> list[str]:
    """{"box.length": "65 mm"} as the command line has it after --set."""
    return [f"{key}={value if isinstance(value, str) else _value(value)}" for key, value in changes.items()]
