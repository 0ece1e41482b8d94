"""Ratios kept between versions: least cost of each point over that of its study's default (other work on the machine only adds),
and its error. No absolute time."""
import csv
import os
import statistics

FILE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "baseline.csv")
SLOWER, LESS_EXACT = 1.5, 1.2
MOST_SPREAD = 3.  # ratios are of least costs: one run that others disturbed shall not hide a row
COLUMNS = ["study", "label", "cost_ratio", "spread", "error"]


def rows_of(studies):
    """Rows of the measured studies, the first default of each with ratio 1; one row for each error of a point."""
    rows = []
    for study in studies:
        reference = next((point for point in study.points if point.default), None)
        for point in study.points:
            for quantity in study.quantities():
                rows.append({"study": study.name, "label": point.label + (f": {quantity}" if quantity else ""),
                             "cost_ratio": min(point.seconds) / min(reference.seconds),
                             "spread": point.spread * reference.spread, "quantity": quantity, "error": study.error_of(point, quantity)})
    return rows


def write(studies, name=FILE):
    """Rewrites the rows of these studies, keeps those of others."""
    measured = {study.name for study in studies}
    rows = [row for row in (read(name) if os.path.exists(name) else []) if row["study"] not in measured] + rows_of(studies)
    with open(name + ".part", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for row in sorted(rows, key=lambda row: row["study"]):
            writer.writerow([f"{row[column]:.3g}" if isinstance(row[column], float) else row[column] for column in COLUMNS])
    os.replace(name + ".part", name)


def read(name=FILE):
    """Rows of a baseline; one that cannot be read ends the script with one sentence."""
    def refuse(sentence):
        raise SystemExit(f"run.py: {sentence}; write one with --write-baseline, or name another with --baseline")

    if not os.path.exists(name):
        refuse(f"there is no baseline {name}")
    try:
        with open(name, newline="", encoding="utf-8") as file:
            table = csv.DictReader(file)
            missing = [column for column in COLUMNS if column not in (table.fieldnames or [])]
            if missing:
                refuse(f"{name} is no baseline to read or rewrite, as it has no column {', '.join(missing)}")
            rows = []
            for row in table:
                try:
                    rows.append({column: row[column] if column in ("study", "label") else float(row[column]) for column in COLUMNS})
                except (TypeError, ValueError):
                    refuse(f"{name}:{table.line_num} is no row of a baseline, as {', '.join(COLUMNS[2:])} are not all numbers")
                if not all(0 <= rows[-1][column] < float("inf") for column in COLUMNS[2:]):
                    refuse(f"{name}:{table.line_num} is no row of a baseline, as {', '.join(COLUMNS[2:])} are not all finite and at least 0")
            return rows
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        refuse(f"the baseline {name} cannot be read ({getattr(error, 'strerror', None) or error})")


def slower_beyond(now, then):
    """Factor of two cost ratios that the spread of the runs explains."""
    return min(max(SLOWER, now["spread"], then["spread"]), MOST_SPREAD)


def worse(studies, stored):
    """What became slower or less exact than the stored rows, as sentences; verdict names what they do not hold."""
    kept = {(row["study"], row["label"]): row for row in stored}
    found = []
    for study in studies:
        rows = [(row, kept[row["study"], row["label"]]) for row in rows_of([study]) if (row["study"], row["label"]) in kept]
        for now, then in rows:
            if not now["quantity"] and now["cost_ratio"] > slower_beyond(now, then) * then["cost_ratio"]:
                found.append(f"{study.name}: {now['label']} became slower: {now['cost_ratio']:.3g} times the default, "
                             f"{then['cost_ratio']:.3g} before")
            if now["error"] > LESS_EXACT * then["error"] + study.floor:
                found.append(f"{study.name}: {now['label']} became less exact: {now['error']:.3g}, {then['error']:.3g} before")
        # where the default itself became slower, all others became cheaper than it by one factor
        others = [then["cost_ratio"] / now["cost_ratio"] for now, then in rows if not now["quantity"] and now["cost_ratio"] != 1]
        if len(others) > 1 and statistics.median(others) > statistics.median(slower_beyond(now, then) for now, then in rows):
            found.append(f"{study.name}: the default became slower: all others by {statistics.median(others):.3g} cheaper beside it")
    return found


def verdict(studies, stored, found):
    """Sentences on what was compared, what was not, and that nothing became worse where nothing was `found`."""
    kept = {(row["study"], row["label"]) for row in stored}
    held = {study for study, _ in kept}
    compared = [study for study in studies if any((study.name, point.label) in kept for point in study.points)]
    said = [f"Not compared, as the baseline has no row of it: {study.name}." for study in studies if study.name not in held]
    said += [f"Not compared, as the baseline has no row of it: {row['study']}: {row['label']}." for row in rows_of(studies)
             if row["study"] in held and (row["study"], row["label"]) not in kept]
    if not studies:
        said.append("No study was compared with the baseline: none was measured.")
    elif not compared:
        said.append("No study was compared with the baseline.")
    elif not found:
        said.append(f"Nothing of the {len(compared)} {'study' if len(compared) == 1 else 'studies'} compared became slower or less exact than the baseline.")
    return said
