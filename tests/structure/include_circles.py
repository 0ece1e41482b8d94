#!/usr/bin/env python3
"""Fails if units include each other in a circle; a header and its source are one unit.

usage: include_circles.py FOLDER...    each with include/vibrocontact and source
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


failed = False
for folder in sys.argv[1:]:
    graph = includes(pathlib.Path(folder))
    if not graph:
        sys.exit("There are no sources in \"" + folder + "\".")
    for circle in circles(graph):
        failed = True
        print("Circle: " + " -> ".join(circle))
        for one, other in zip(circle, circle[1:]):
            print("  " + str(graph[one][other]) + " includes " + other + ".h")
    print(folder + ": " + str(len(graph)) + " units")
sys.exit(failed)
