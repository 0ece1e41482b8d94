#!/usr/bin/env python3
"""survival.py PROGRAM MPIRUN PARAMETER_FILES: damaged files and runs that meet leave no wrong result.

flips          one bit of what an interrupted run left is turned, or its end cut off, then --resume: refused in one
               sentence, or the same bits as of a run without interruption
double starts  two runs, or two --resume, in one folder: one is refused and touches nothing, the other ends as if it were
               alone
shared cache   two runs in two folders that compute the same reduction at once
kills          while another run waits to take over the folder at once

VIBROCONTACT_KILLS=200 in the environment: so many of each instead of 3.
"""
import json, os, random, re, shutil, signal, subprocess, sys, time

from h5py_of_system import h5py

program, mpirun, files = sys.argv[1:4]
n_trials = int(os.environ.get("VIBROCONTACT_KILLS", "3"))
random.seed(2)


def fail(text):
    sys.exit("FAILED: " + text)


def content(folder):
    """What a run says, without times, and its histories."""
    columns = {}
    for part in ("histories", "signals"):
        if os.path.exists(f"{folder}/{part}.h5"):
            with h5py.File(f"{folder}/{part}.h5") as file:
                columns.update({f"{part}/{name}": file[name][:].tobytes() for name in file})
    results = json.load(open(folder + "/results.json"))
    if not results["complete"] or results["status"] != "converged":
        fail(f"{folder} is not complete")

    def strip(node):
        if isinstance(node, dict):
            return {key: strip(value) for key, value in node.items() if "seconds" not in key}
        return [strip(value) for value in node] if isinstance(node, list) else node

    columns["analyses"] = json.dumps(strip(results["analyses"]))
    return columns


class Case:
    def __init__(self, label, example, checkpoint, *settings):
        self.label, self.checkpoint = label, checkpoint
        self.command = [program, f"{files}/examples/{example}.prm", "--quiet"]
        for setting in (*settings, "Output/Figures=false", "Output/Fields=false"):
            self.command += ["--set", setting]
        begin = time.time()
        self.run(self.folder("whole"))
        self.duration = time.time() - begin
        self.whole = content(self.folder("whole"))

    def folder(self, case):
        return f"{self.label}_{case}"

    def start(self, folder, *options):
        return subprocess.Popen(self.command + ["--output", folder, *options], stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True)

    def run(self, folder, *options, codes=(0,)):
        process = self.start(folder, *options)
        message = process.communicate()[1]
        if process.returncode not in codes:
            fail(f"exit code {process.returncode} of {folder} {options}: {message}")
        if process.returncode == 1 and len(message.splitlines()) != 1:
            fail(f"{folder} is refused by more than a sentence: {message}")
        return process.returncode, message

    def check(self, folder):
        if content(folder) != self.whole:
            fail(f"{folder} differs from a run without interruption")

    def interrupted(self, folder):
        """Killed when some checkpoints have been written."""
        while True:
            shutil.rmtree(folder, ignore_errors=True)
            process = self.start(folder)
            while process.poll() is None and not os.path.exists(f"{folder}/{self.checkpoint}"):
                time.sleep(1e-3)
            time.sleep(random.uniform(0.1, 0.6) * self.duration)
            process.kill()
            process.communicate()
            if os.path.exists(folder + "/histories.rows"):
                return

    def flips(self):
        left, folder = self.folder("left"), self.folder("flipped")
        refused = {}
        for trial in range(n_trials):
            if trial % 20 == 0:
                self.interrupted(left)
            shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(left, folder)
            names = [name for name in ("histories.rows", "signals.rows", self.checkpoint, "results.json", "used.prm")
                     if os.path.exists(f"{folder}/{name}")]
            name = names[trial % len(names)]
            path = f"{folder}/{name}"
            data = bytearray(open(path, "rb").read())
            # used.prm: values only, its comments are not read
            places = range(8 * len(data))
            if trial % 7 == 6:
                del data[random.randrange(len(data)):]
            else:
                place = random.choice(places)
                data[place // 8] ^= 1 << place % 8
            open(path, "wb").write(data)
            code, message = self.run(folder, "--resume", codes=(0, 1))
            one = refused.setdefault(name, [0, 0])
            one[code] += 1
            if code == 0:
                self.check(folder)
            elif name != "used.prm" and "--resume" not in message:
                fail(f"{name} is refused with: {message}")
        for name, (same, no) in sorted(refused.items()):
            print(f"{self.label}, bits of {name} turned: {no} refused, {same} ended with the right bits")

    def double_starts(self):
        left, met = self.folder("left"), 0
        if not os.path.exists(left):
            self.interrupted(left)
        for trial in range(n_trials):
            folder = self.folder("double")
            shutil.rmtree(folder, ignore_errors=True)
            options = []
            if trial % 3 == 1:
                shutil.copytree(left, folder)
                options = ["--resume"]
            if trial % 3 == 2:
                shutil.copytree(self.folder("whole"), folder)
            pair = []
            for k in range(2):
                pair.append(self.start(folder, *options))
                time.sleep(random.uniform(0, 0.3 * self.duration) if k == 0 and trial % 2 else 0)
            messages = [process.communicate()[1] for process in pair]
            codes = [process.returncode for process in pair]
            if sorted(codes) not in ([0, 0], [0, 1]):
                fail(f"two runs in one folder end with {codes}: {messages}")
            if 1 in codes:
                met += 1
                message = messages[codes.index(1)]
                # a holder that the machine stops for a second has not yet written its name
                if not re.search(r"another run writes to the folder .*\((.* since .*|it has just begun)\)", message):
                    fail(f"the second run is refused with: {message}")
            self.check(folder)
        print(f"{self.label}: {met} of {n_trials} double starts met; one was refused, the other ended as if alone")

    def takeovers(self):
        """A run is killed and the next one starts at the same moment."""
        met, folder = 0, self.folder("taken")
        shutil.rmtree(folder, ignore_errors=True)
        options = []
        for trial in range(n_trials):
            process = self.start(folder, *options)
            time.sleep(random.uniform(0, 1.2 * self.duration))
            process.kill()
            options = ["--resume"] if os.path.exists(folder + "/results.json") else []
            follower = self.start(folder, *options)
            process.communicate()
            met += process.returncode == -signal.SIGKILL
            time.sleep(random.uniform(0, 0.5 * self.duration))
            follower.kill()
            message = follower.communicate()[1]
            if follower.returncode not in (0, 1, -signal.SIGKILL):
                fail(f"exit code {follower.returncode} after a takeover: {message}")
            options = ["--resume"] if os.path.exists(folder + "/results.json") else []
        self.run(folder, *options)
        self.check(folder)
        print(f"{self.label}: {met} of {n_trials} kills met the run that was taken over; the right bits in the end")

    def shared_cache(self):
        for trial in range(n_trials):
            for name in ("one", "two", "cache"):
                shutil.rmtree(self.folder(name), ignore_errors=True)
            setting = ["--set", f"Output/Cache directory={self.folder('cache')}"]
            pair = [self.start(self.folder(name), *setting) for name in ("one", "two")]
            if trial % 3 == 2:
                time.sleep(random.uniform(0, 0.5 * self.duration))
                pair[0].kill()
            messages = [process.communicate()[1] for process in pair]
            if trial % 3 == 2:
                self.run(self.folder("one"), *setting)
            elif pair[0].returncode != 0 or messages[0]:
                fail(f"two runs with one cache: {messages}")
            if pair[1].returncode != 0 or messages[1]:
                fail(f"two runs with one cache: {messages}")
            self.check(self.folder("one"))
            self.check(self.folder("two"))
        print(f"{self.label}: {n_trials} pairs of runs wrote the same reductions at once")


bar = Case("bar", "bouncing_bar", "checkpoint.h5", "Transient/End time=4",
           "Transient/Checkpoint interval=1e-9", "Transient/Signals/Probes=top: bar 0 0 10 along z")
bar.flips()
bar.double_starts()
bar.takeovers()
bar.shared_cache()
oscillator = Case("oscillator", "tyre_three_points", "modal_convolution.h5",
                  "Modal convolution/Checkpoint interval=1e-9", "Modal convolution/End time=4")
oscillator.flips()
oscillator.double_starts()
