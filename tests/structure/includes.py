#!/usr/bin/env python3
"""Fails if units include each other in a circle (a header and its source are one unit), or a folder includes one below it.

usage: includes.py FOLDER...    each with include/vibrocontact, source and the table of folders in doc/extending.md
"""
import pathlib
import re
import sys


def includes(root):
    """The units that each unit of a folder includes, with the file that does so."""
    result = {}
    for tree in (root / "include/vibrocontact", root / "source"):
        for file in sorted(tree.rglob("*")):
            if file.suffix not in (".h", ".cc"):
                continue
            unit = str(file.relative_to(tree).with_suffix(""))
            own = result.setdefault(unit, {})
            for name in re.findall(r'^\s*#\s*include\s*[<"]vibrocontact/([^>"]+)\.h[>"]', file.read_text(), re.M):
                if name != unit:
                    own.setdefault(name, file.relative_to(root))
    return result


def reached(graph, start):
    """The shortest ways from the units that `start` includes, by the unit they lead to."""
    ways = {name: [name] for name in graph.get(start, {})}
    ends = list(ways)
    for end in ends:
        for name in graph.get(end, {}):
            if name not in ways:
                ways[name] = ways[end] + [name]
                ends.append(name)
    return ways


def circles(graph):
    """A shortest circle through each unit that is in one, each circle once."""
    found = {}
    for unit in sorted(graph):
        way = reached(graph, unit).get(unit)
        if way:
            found.setdefault(frozenset(way), [unit] + way)
    return list(found.values())


def folders_in_order(root):
    """The folders of the table in doc/extending.md, each of which may include those before it."""
    rows = re.findall(r"^\| ((?:`\w+`(?:, )?)+) \|", (root / "doc/extending.md").read_text(), re.M)
    return [name for row in rows for name in re.findall(r"\w+", row)]


def room(unit):
    """Folder of a unit; each analysis is one of its own."""
    parts = unit.split("/")
    return "/".join(parts[:2]) if parts[0] == "analyses" else parts[0]


def out_of_order(graph, order):
    """Includes of a folder further down; analyses know no other analysis, and ask `run` for prepared bodies."""
    for unit, own in sorted(graph.items()):
        if unit == "main":
            continue
        for name, file in own.items():
            here, there = room(unit), room(name)
            if here == there or here.startswith("analyses/") and there == "run":
                continue
            rank, other = (order.index(one.split("/")[0]) for one in (here, there))
            if other >= rank:
                yield str(file) + " includes " + name + ".h, but " + here + " knows nothing of " + there


failed = False
for folder in sys.argv[1:]:
    root = pathlib.Path(folder)
    graph = includes(root)
    if not graph:
        sys.exit("There are no sources in \"" + folder + "\".")
    for circle in circles(graph):
        failed = True
        print("Circle: " + " -> ".join(circle))
        for one, other in zip(circle, circle[1:]):
            print("  " + str(graph[one][other]) + " includes " + other + ".h")
    for sentence in out_of_order(graph, folders_in_order(root)):
        failed = True
        print(sentence)
    print(folder + ": " + str(len(graph)) + " units")
sys.exit(failed)
