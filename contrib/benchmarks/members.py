"""Which methods the program lets a file choose, read from what --parameters prints; each belongs on a picture."""
import re

# Entries with named choices that say what is computed, for what scene or what is written: no way to compute the same.
NOT_METHODS = {
    "Type": "kind of body",
    "Beam rail/Contact at": "place", "Rail/Contact at": "place", "Block/Contact face": "place", "Block/Held": "support",
    "Bar/Far end": "support", "Rail/Sleeper model": "track", "Rail/Rails": "track", "Rail/Beyond supports": "track",
    "Ring/Pressure": "load", "Mesh/Geometry": "shape", "Rolling/Hub": "support",
    "Wheel/Damper/NAME/Kind": "kind of damper", "Wheel/Damper/NAME/Direction": "direction",
    "Contact/Normal law": "law of the surfaces", "Contact/Friction law": "law of the surfaces",
    "Stability/Loss": "law of the material", "Stability/Roots": "which roots",
    # stability_sweep shows it all the same, with the share of the roots that each lists
    "Stability/Roots of a sweep": "which roots: all, or those that grow or may; the argument by which the latter are complete does not see "
                                  "one that grows between two complete cases only", "Transient/Initial state": "start",
    "Modal convolution/Initial state": "start", "Road/Profile": "road", "Road/Class": "road",
    "Road/Table interpolation": "road between its samples",
    "Frequency response/Spacing": "which frequencies", "Frequency response/Quantity": "which quantity",
    "Periodic/Stop direction": "direction", "Periodic/Continuation/Parameter": "what is varied",
    "Limit cycle/Branch/Entry": "what is varied", "Limit cycle/Start": "start",
    "Output/Deformation": "output", "Output/Contact patches": "output", "Export/Form": "output",
}
# Members that compute something else, or nothing.
NOT_MEMBERS = {("Periodic/Continuation/Stability", "none"): "no stability"}
# Entries whose choices stand in their text because several may be named.
LISTS = {"Identification/Method": re.compile(r"^(.*?), or several, separated by commas")}


def choices(parameters):
    """Members by entry, of all entries with named choices; the name of a body's section is left out. A text with a comma in a
    name (direct convolution, scalar) is put together again."""
    found, sections, comment = {}, [], ""
    for line in parameters.splitlines():
        # bodies of other kinds stand in the printed file as comments
        line = re.sub(r"^#\s+(?=#|subsection|set |end\b)", "", line).strip()
        if line.startswith("subsection "):
            sections.append(line.split(None, 1)[1])
        elif line == "end" and sections:
            sections.pop()
        elif line.startswith("set "):
            name = line[4:].split("=")[0].strip()
            members = re.search(r"Value: (?:a list[^.]*? of )?one of: (.*?)\. Default:", comment)
            path = sections + [name]
            # a body's own entries
            if len(path) > 1 and not path[0][0].isupper():
                path = path[1:]
            entry = "/".join(path)
            if members:
                found[entry] = members.group(1).replace("convolution, scalar", "convolution; scalar").split(", ")
            elif entry in LISTS:
                found[entry] = LISTS[entry].match(comment.strip()).group(1).split(", ")
        elif line.startswith("#"):
            comment += " " + line.lstrip("# ")
            continue
        comment = ""
    return {entry: [member.replace("; ", ", ") for member in members] for entry, members in found.items()}


def without_picture(parameters, studies):
    """Entries and members that no study shows, as sentences."""
    shown = {}
    for study in studies:
        for entry, members in study.choices.items():
            shown.setdefault(entry, set()).update(members)
    missing = []
    for entry, members in choices(parameters).items():
        if entry not in NOT_METHODS:
            missing += [f"{entry} = {member} is on no picture" for member in members
                        if member not in shown.get(entry, ()) and (entry, member) not in NOT_MEMBERS]
    return missing
