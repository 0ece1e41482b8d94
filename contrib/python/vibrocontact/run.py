"""A run of the program: its progress, its end, what the end means."""
from __future__ import annotations

import codecs
import os
import re
import shutil
import signal as signals
import subprocess
import threading
from dataclasses import dataclass
from pathlib import Path
from typing import Iterator, List, Optional, Sequence

from .errors import CannotWrite, InputError, Killed, NotConverged, ProgramFault, Stopped, UnknownEntry, VibrocontactError
from .program import environment
from .results import Results

# as Progress of the program writes it: "wheel: modes: 12 %, 34 s, about 4 min 05 s left, detail"
TIME = r"(?:\d+ min \d\d s|[\d.e+-]+ s)"
PROGRESS = re.compile(rf"^(?P<what>.+?): (?:(?P<percent>\d+) %, )?{TIME}(?:, about (?P<left>{TIME}) left)?(?:, .*)?$")
STOPS = (signals.SIGTERM, signals.SIGINT)


@dataclass(frozen=True)
class Line:
    """What the program says: a line of its log, or how far a long step is.

    text     as on the screen
    percent  of the step that is done; None if this is not known or not a progress
    left_s   seconds that the step will still take; None likewise
    """
    text: str
    percent: Optional[float] = None
    left_s: Optional[float] = None

    @property
    def is_progress(self) -> bool:
        """Whether the program replaces this line by the next one."""
        return self.percent is not None or self.left_s is not None

    @staticmethod
    def read(text: str) -> "Line":
        """A line of the screen."""
        text = text.strip()
        match = PROGRESS.match(text)
        if not match or not (match["percent"] or match["left"]):
            return Line(text)
        return Line(text, float(match["percent"]) if match["percent"] else None, seconds(match["left"]))


def seconds(text: Optional[str]) -> Optional[float]:
    """Of "12.3 s" or "4 min 05 s"."""
    if not text:
        return None
    minutes, _, rest = text.rpartition(" min ")
    return 60 * float(minutes or 0) + float(rest[:-2])


class Run:
    """A run that has been started. It goes on by itself; `wait()` gives its results or raises what went wrong.

    folder  for its results
    lines   what it has said so far

    As a context (`with case.start(...) as run:`) it is stopped when the block is left before its end.
    """

    def __init__(self, command: Sequence[str], folder: Path, scratch: Optional[Path] = None):
        """Starts it.

        command  words of the command line
        scratch  folder that is removed at the end
        """
        self.folder, self.lines = folder, []  # type: Path, List[Line]
        self._scratch, self._behind_mpirun = scratch, Path(command[0]).name.startswith("mpi")
        self._changed = threading.Condition()
        self._errors = ""
        self._killed_for_memory = killed_for_memory()
        self._told_to_stop = False
        try:
            # a group of its own: Ctrl-C reaches the caller, who stops the run. As on a terminal of 400 columns the program
            # says every second how far it is
            self._process = subprocess.Popen(list(command), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, process_group=0,
                                             env=dict(environment(), VIBROCONTACT_TERMINAL="400"))
        except OSError as error:
            self._clean()
            raise ProgramFault(f"{command[0]} cannot be started: {error.strerror}") from error
        self._readers = [threading.Thread(target=self._read_screen, daemon=True), threading.Thread(target=self._read_errors, daemon=True)]
        for reader in self._readers:
            reader.start()

    @property
    def pid(self) -> int:
        """Of the program, or of mpirun."""
        return self._process.pid

    @property
    def running(self) -> bool:
        return self._process.poll() is None

    def progress(self) -> Iterator[Line]:
        """Lines as they are said, from the first one on, until the run ends. Raises nothing: `wait()` does."""
        told = 0
        while True:
            with self._changed:
                self._changed.wait_for(lambda: len(self.lines) > told or not self._readers[0].is_alive(), timeout=0.5)
                new = self.lines[told:]
                ended = not new and not self._readers[0].is_alive()
            yield from new
            told += len(new)
            if ended:
                return

    def wait(self, timeout: Optional[float] = None) -> Results:
        """Waits for the end, at most `timeout` seconds (then subprocess.TimeoutExpired, and it goes on); stops the run on Ctrl-C.

        Raises InputError, UnknownEntry, NotConverged, CannotWrite, ProgramFault, Killed or Stopped (errors.py)."""
        try:
            self._process.wait(timeout)
        except KeyboardInterrupt:
            self.stop()
            raise
        for reader in self._readers:
            reader.join(10)  # a rank that outlives mpirun may hold what they read
        self._clean()
        return self._outcome()

    def stop(self, patience: float = 60) -> Optional[Results]:
        """Stops the run by SIGTERM and waits for it: a march in time writes a checkpoint within 50 steps, a sweep ends its cases; killed after
        `patience` seconds. Returns the results so far, None if there are none. A run that has ended stays as it is."""
        if self.running:
            self._told_to_stop = True
            self._signal(signals.SIGTERM)
            try:
                self._process.wait(patience)
            except subprocess.TimeoutExpired:
                os.killpg(self._process.pid, signals.SIGKILL)
        try:
            return self.wait()
        except VibrocontactError as error:
            return getattr(error, "results", None)

    def _signal(self, number: int) -> None:
        """To the program itself: mpirun that is signalled kills its ranks before they have written a checkpoint."""
        ranks: List[str] = []
        if self._behind_mpirun:
            try:
                ranks = Path(f"/proc/{self.pid}/task/{self.pid}/children").read_text(encoding="ascii").split()
            except OSError:
                pass
        for rank in ranks:
            try:
                os.kill(int(rank), number)
            except ProcessLookupError:  # it has just ended
                pass
        if not ranks:
            self._process.send_signal(number)

    def __enter__(self) -> "Run":
        return self

    def __exit__(self, *_: object) -> None:
        if self.running:
            self.stop()

    def _clean(self) -> None:
        if self._scratch:
            shutil.rmtree(self._scratch, ignore_errors=True)

    def _say(self, text: str) -> None:
        if not text.strip():
            return
        line = Line.read(text)
        with self._changed:
            self.lines.append(line)
            self._changed.notify_all()

    def _read_screen(self) -> None:
        rest, decoder = "", codecs.getincrementaldecoder("utf-8")("replace")
        with self._process.stdout as screen:  # type: ignore[union-attr]
            while chunk := os.read(screen.fileno(), 65536):
                # a progress has no end of its own: it is shown as it is
                *whole, rest = re.split(r"\r?\n|\r\x1b\[K", rest + decoder.decode(chunk))
                for text in whole:
                    self._say(text)
                if Line.read(rest).is_progress:
                    self._say(rest)
                    rest = ""
        self._say(rest)

    def _read_errors(self) -> None:
        with self._process.stderr as pipe:  # type: ignore[union-attr]
            self._errors = pipe.read().decode(errors="replace")

    def _results(self) -> Optional[Results]:
        try:
            return Results(self.folder)
        except VibrocontactError:
            return None

    def _outcome(self) -> Results:
        code = self._process.returncode
        sentence = last_sentence(self._errors)
        if code == 0:
            return Results(self.folder)
        if code == 1 and sentence:
            raise input_error(sentence)
        if code == 2:
            results = self._results()
            messages = list(results.data.get("messages", [])) if results else []
            raise NotConverged("; ".join(messages) or sentence or f"a computation of the run in {self.folder} did not converge; its results so far are kept",
                               results, messages)
        if code == 3 and "cannot be written" in sentence:
            free = f"{shutil.disk_usage(self.folder).free / 1e6:.0f} MB are free in {self.folder}; " if self.folder.exists() else ""
            raise CannotWrite(f"{sentence}. {free}what was written stays. Make room, then start it again there with resume=True", self.folder)
        signal = -code if code < 0 else code - 128
        if self._told_to_stop and signal not in STOPS and not sentence:
            signal = signals.SIGTERM  # killed after it, or mpirun before it had started its ranks: code 1
        if signal in STOPS:
            raise Stopped(signal, self.folder, self._results())
        if signal > 0:
            raise self._killed(signal)
        raise ProgramFault(sentence or f"exit code {code}: " + (self._errors.strip()[-2000:] or "nothing was said"))

    def _killed(self, signal: int) -> Killed:
        try:
            name = signals.Signals(signal).name
        except ValueError:
            name = f"signal {signal}"
        memory = killed_for_memory() > self._killed_for_memory
        text = f"the run in {self.folder} was killed by {name}"
        if signal == signals.SIGKILL:
            text += ("; the system has killed processes for memory meanwhile" if memory else ", as the system does when memory runs out")
            text += (f". {free_memory() / 1e9:.1f} GB are free now, case.check() says how much a case needs: take fewer ranks, a coarser mesh or a lower degree, "
                     "a beam rail in place of a solid one, or a larger machine")
        text += ". With resume=True in the same folder it goes on from its last checkpoint"
        return Killed(text, signal, memory, self.folder)


def last_sentence(errors: str) -> str:
    """What the program said last of what went wrong, of the text of its error stream; empty if nothing."""
    said = [line for line in errors.splitlines() if line.startswith("vibrocontact: ")]
    return said[-1][len("vibrocontact: "):] if said else ""


def input_error(sentence: str) -> InputError:
    """Of the program's sentence; an unknown name with the names that it suggests."""
    unknown = re.search(r' has no (?:entry|subsection) "([^"]*)"', sentence)
    if not unknown:
        return InputError(sentence)
    suggested = re.search(r"(?:did you mean|valid is|valid are) (.*)", sentence)
    return UnknownEntry(sentence, unknown[1], re.findall('"([^"]*)"', suggested[1]) if suggested else ())


def killed_for_memory() -> int:
    """How many processes the system has killed for memory since it began."""
    try:
        with open("/proc/vmstat", encoding="ascii") as lines:
            return next((int(line.split()[1]) for line in lines if line.startswith("oom_kill ")), 0)
    except OSError:
        return 0


def free_memory() -> float:
    """Bytes that are available now."""
    try:
        with open("/proc/meminfo", encoding="ascii") as lines:
            return next((1024. * int(line.split()[1]) for line in lines if line.startswith("MemAvailable:")), 0.)
    except OSError:
        return 0.
