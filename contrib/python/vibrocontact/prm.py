"""Texts of parameter files: entries by their paths, and back."""
from __future__ import annotations

from pathlib import Path
from typing import Any, Dict, Iterator, List, Mapping, Sequence, Tuple, Union

from .errors import InputError

Value = Union[str, bool, int, float, Path, Sequence[Any]]
"""Of an entry: text, true or false, a number, or a list of them."""
Entries = Mapping[str, Any]
"""Values by entry, nested by section or with paths as keys: {"Contact": {"Grid spacing": 1e-3}, "Rolling/Speed": 10}."""


def statements(text: str) -> Iterator[Tuple[str, str]]:
    """Lines of a parameter file as (keyword, rest), without comments, continued lines joined."""
    begun = ""
    for raw in text.splitlines():
        line = begun + raw.split("#")[0].strip()
        if line.endswith("\\"):
            begun = line[:-1].strip() + " "
            continue
        begun = ""
        if line.strip():
            keyword, *rest = line.split(None, 1)
            yield keyword, "".join(rest)


def read_entries(text: str) -> Dict[str, str]:
    """Values of a parameter file by the paths of their entries, in the file's order. Whether they are valid is the program's to say."""
    entries: Dict[str, str] = {}
    sections: List[str] = []
    for keyword, rest in statements(text):
        if keyword == "subsection":
            sections.append(" ".join(rest.split()))
        elif keyword == "end" and sections:
            sections.pop()
        elif keyword == "set":
            name, _, value = rest.partition("=")
            entries["/".join([*sections, " ".join(name.split())])] = value.strip()
    return entries


def value_text(path: str, value: Any) -> str:
    """A value as it stands in a parameter file; numbers keep all their digits. Raises InputError for what no file can hold."""
    if hasattr(value, "tolist"):  # of numpy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (str, Path)):
        text = str(value).strip()
        if any(letter in text for letter in "#\n\r") or text.endswith("\\"):
            raise InputError(f'{path} is "{text}", but a value stands on one line, holds no "#" and ends in no backslash: write it without')
        return text
    if isinstance(value, Sequence):
        return ", ".join(value_text(path, one) for one in value)
    raise InputError(f"{path} is of type {type(value).__name__}: give a text, true or false, a number or a list of them")


def flat(entries: Entries, section: str = "") -> Dict[str, str]:
    """Texts of the values by the paths of their entries."""
    result: Dict[str, str] = {}
    for name, value in entries.items():
        path = "/".join(" ".join(part.split()) for part in (section + "/" + str(name)).split("/") if part.strip())
        if isinstance(value, Mapping):
            result.update(flat(value, path))
        else:
            result[path] = value_text(path, value)
    return result


def write_entries(entries: Mapping[str, str]) -> str:
    """A parameter file of these values, section by section."""
    tree: Dict[str, Any] = {}
    for path, value in entries.items():
        *sections, name = path.split("/")
        node = tree
        for section in sections:
            node = node.setdefault("subsection " + section, {})
        node["set " + name] = value

    def lines(node: Mapping[str, Any], indent: str) -> Iterator[str]:
        for key, value in sorted(node.items(), key=lambda item: isinstance(item[1], dict)):
            if isinstance(value, dict):
                yield f"{indent}{key}"
                yield from lines(value, indent + "  ")
                yield f"{indent}end"
            else:
                yield f"{indent}{key} = {value}"

    return "\n".join(lines(tree, "")) + "\n"
