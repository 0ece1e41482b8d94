"""What scripts share: parameter files are written, run and read."""
import csv, json, os, sys

from many_runs import ManyRuns

program, mpirun = sys.argv[1:3]
runs = ManyRuns(program, mpirun)


def section(name, *lines):
    return f"subsection {name}\n" + "\n".join(lines) + "\nend"


def entries(**values):
    """Entries of a section; _ in their names means a space."""
    return "\n".join(f"set {name.replace('_', ' ')} = {value}" for name, value in values.items())


def run(name, text, ranks=1, *options, may_doubt=False):
    """Runs a file and returns results.json and its folder. may_doubt: also if the program itself doubts the results."""
    with open(name + ".prm", "w") as file:
        file.write(text + "\n" + section("Output", entries(Directory=name, Cache_directory="cache", Figures="false")))
    done = runs.run([name + ".prm", "--quiet", *options], ranks)
    if done.returncode != 0 and not (may_doubt and done.returncode == 2):
        sys.exit(f"FAILED: {name}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return json.load(open(os.path.join(name, "results.json")))["analyses"], name


def write_matrix(name, matrix):
    """A list of rows as a file of Matrix Market, general."""
    with open(name, "w") as file:
        file.write(f"%%MatrixMarket matrix array real general\n{len(matrix)} {len(matrix[0])}\n")
        for j in range(len(matrix[0])):
            for row in matrix:
                file.write(f"{row[j]!r}\n")


def table(folder, name):
    """Rows of a table, by column."""
    with open(os.path.join(folder, name)) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return [{key: value if key in ("label", "curve", "kind", "root", "receptance", "entry", "direction", "stability", "message") else float(value) for key, value in row.items()} for row in rows]


class Check:
    """Compares numbers, says what is wrong and fails at the end."""

    def __init__(self):
        self.wrong = self.checked = 0
        self.largest = 0

    def near(self, what, got, expected, tolerance, scale=None):
        error = abs(got - expected) / (scale if scale else max(abs(expected), 1e-300))
        self.checked += 1
        self.largest = max(self.largest, error / tolerance)
        if not error <= tolerance:
            self.wrong += 1
            print(f"WRONG {what}: {got:.12g}, expected {expected:.12g}, relative error {error:.2g} > {tolerance:g}")

    def end(self):
        print(f"{self.checked} numbers, {self.wrong} wrong, largest error {self.largest:.2g} of its tolerance")
        sys.exit(1 if self.wrong or not self.checked else 0)
