"""The program, run many times from one start: to load its libraries takes half a second."""
import json, os, subprocess, tempfile


class ManyRuns:
    """Runs of one rank are copies of a process, tests/run_many.cc; those of several are started by mpirun."""

    def __init__(self, program, mpirun=None):
        self.program, self.mpirun = program, mpirun
        self.copies = None
        self.files = tempfile.TemporaryDirectory()

    def run(self, arguments, ranks=1, folder="."):
        """As subprocess.run() in a folder: returncode, stdout and stderr."""
        if ranks > 1:
            words = [self.mpirun, "-n", str(ranks), self.program, *arguments]
            return subprocess.run(words, cwd=folder, capture_output=True, text=True)
        if not self.copies:
            copies = os.path.join(os.path.dirname(self.program), "tests", "run_many")
            self.copies = subprocess.Popen([copies], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        said = [os.path.join(self.files.name, name) for name in ("screen", "errors")]
        request = {"folder": os.path.abspath(folder), "screen": said[0], "errors": said[1], "arguments": arguments}
        self.copies.stdin.write(json.dumps(request) + "\n")
        self.copies.stdin.flush()
        code = int(self.copies.stdout.readline())
        return subprocess.CompletedProcess(arguments, code, *(open(name, errors="replace").read() for name in said))
