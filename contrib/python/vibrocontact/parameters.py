"""The program's own list of its parameters."""
from __future__ import annotations

import functools
import re
import subprocess
from dataclasses import dataclass, field
from pathlib import Path
from typing import Dict, Iterable, Iterator, List, Mapping, Set, Tuple, Union

from .errors import ProgramNotFound
from .program import environment, find_program


@dataclass(frozen=True)
class Parameter:
    """An entry as `--parameters` describes it.

    path     "Contact/Friction coefficient"; of a body with its type in front: "wheel/Material/Density"
    meaning  in words
    unit     SI; "none" for what has none
    values   which are valid, in words
    default  as text; may be empty
    """
    path: str
    meaning: str
    unit: str
    values: str
    default: str


@dataclass
class Catalogue:
    """All entries of a program.

    common  by path: those of the file as a whole
    bodies  by type of body, then by the path within the body's section
    """
    common: Dict[str, Parameter] = field(default_factory=dict)
    bodies: Dict[str, Dict[str, Parameter]] = field(default_factory=dict)

    def __iter__(self) -> Iterator[Parameter]:
        yield from self.common.values()
        for entries in self.bodies.values():
            yield from entries.values()

    def search(self, words: str) -> List[Parameter]:
        """Entries whose path or meaning holds all of these words."""
        return [one for one in self if all(word.lower() in (one.path + " " + one.meaning).lower() for word in words.split())]

    def paths(self, entries: Mapping[str, str]) -> Set[str]:
        """Paths that are valid beside these entries, which name the bodies and their types."""
        valid = set(self.common)
        for body in names(entries.get("Bodies", self.common["Bodies"].default)):
            kind = entries.get(f"{body}/Type", self.bodies["wheel"]["Type"].default)
            valid.update(f"{body}/{path}" for path in self.bodies.get(kind, {}))
            for material in names(entries.get(f"{body}/Materials", "")):
                valid.update(f"{body}/Material/{material}/{path[9:]}" for path in self.bodies.get(kind, {}) if path.startswith("Material/"))
            for damper in names(entries.get(f"{body}/Wheel/Dampers", "")):
                valid.update(f"{body}/{path}".replace("/NAME/", f"/{damper}/") for path in self.bodies.get(kind, {}))
        return valid

    def unknown(self, paths: Iterable[str], entries: Mapping[str, str]) -> List[str]:
        """Those of `paths` that the list does not hold beside `entries`; what stands in the section of a named contact is never among them."""
        valid, contacts = self.paths(entries), names(entries.get("Contacts", ""))
        return [path for path in paths if path not in valid and path.split("/")[0] not in contacts]


def names(text: str) -> List[str]:
    """Members of a list as a parameter file writes it."""
    return [one.strip() for one in text.split(",") if one.strip()]


def parameters(program: Union[str, Path, None] = None) -> Catalogue:
    """The catalogue of a program, asked once for each build of it. Raises ProgramNotFound if it does not answer."""
    path = find_program(program)
    stamp = path.stat()
    return _asked(path, (stamp.st_mtime_ns, stamp.st_size))


@functools.lru_cache(maxsize=8)
def _asked(path: Path, build: Tuple[int, int]) -> Catalogue:
    try:
        said = subprocess.run([str(path), "--parameters"], capture_output=True, text=True, errors="replace", env=environment(), stdin=subprocess.DEVNULL)
        text, error = said.stdout, said.stderr
    except OSError as failure:
        text, error = "", str(failure)
    catalogue = read_catalogue(text)
    if "Bodies" not in catalogue.common or "wheel" not in catalogue.bodies:
        raise ProgramNotFound(f"{path} --parameters does not list the entries ({(error.strip().splitlines() or ['no word'])[-1]}): build it anew, "
                              "or name another by program=...")
    return catalogue


def read_catalogue(text: str) -> Catalogue:
    """What `--parameters` prints: entries of a file with the bodies wheel and rail; then, as comments, sections of the other types of
    bodies; each entry under a comment with its meaning, unit, values and default."""
    catalogue = Catalogue()
    sections: List[str] = []
    comment: List[str] = []
    are_comments = False
    for line in text.splitlines():
        if re.match(r"# A (body of type|damper NAME) ", line):
            are_comments = True
        if are_comments:
            line = re.sub("^# ?", "", line)
        line = line.strip()
        keyword, _, rest = line.partition(" ")
        if keyword == "#":
            comment.append(rest)
            continue
        if keyword == "subsection":
            sections.append(rest)
        elif keyword == "end" and sections:
            sections.pop()
        elif keyword == "set":
            name = rest.partition("=")[0].strip()
            parameter = described("/".join([*sections, name]), " ".join(comment))
            if sections and (are_comments or sections[0] in ("wheel", "rail")):
                catalogue.bodies.setdefault(sections[0], {})["/".join([*sections[1:], name])] = parameter
            else:
                catalogue.common[parameter.path] = parameter
        comment = []
    return catalogue


def described(path: str, comment: str) -> Parameter:
    """An entry by the comment above it."""
    meaning, _, rest = comment.partition(" Value: ")
    meaning, _, unit = meaning.partition(" Units: ")
    values, _, default = rest.rpartition(" Default: ")
    default = default[:-1] if default.endswith(".") else default
    return Parameter(path, meaning.strip(), unit.strip().rstrip("."), values.strip().rstrip("."), "" if default == "empty" else default)
