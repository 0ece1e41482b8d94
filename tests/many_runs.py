"""The program, run many times from one start: to load its libraries takes half a second."""
import json, os, subprocess, sys, tempfile


class ManyRuns:
    """Runs of one rank are copies of a process, tests/run_many.cc, one after the other; those of several are started by mpirun."""

    def __init__(self, program, mpirun=None):
        self.program, self.mpirun = os.path.abspath(program), mpirun
        self.copies = None
        self.files = tempfile.TemporaryDirectory()

    def run(self, arguments, ranks=1, folder="."):
        """As subprocess.run() in a folder: returncode, stdout and stderr."""
        if ranks > 1:
            words = [self.mpirun, "-n", str(ranks), self.program, *arguments]
            return subprocess.run(words, cwd=folder, capture_output=True, text=True, errors="replace")
        if not self.copies:
            copies = os.path.join(os.path.dirname(self.program), "tests", "run_many")
            if not os.path.exists(copies):
                sys.exit(f"FAILED: there is no {copies}: build the target run_many, and give the program of that build")
            self.copies = subprocess.Popen([copies], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        said = [os.path.join(self.files.name, name) for name in ("screen", "errors")]
        request = {"folder": os.path.abspath(folder), "screen": said[0], "errors": said[1], "arguments": arguments}
        self.copies.stdin.write(json.dumps(request) + "\n")
        self.copies.stdin.flush()
        code = self.copies.stdout.readline()
        if not code:
            sys.exit(f"FAILED: {self.copies.args} ended with {self.copies.wait()} when it was asked for {request}")
        return subprocess.CompletedProcess(arguments, int(code), *(open(name, errors="replace").read() for name in said))
