#!/usr/bin/env python3
"""interrupted.py PROGRAM MPIRUN PARAMETER_FILES: an interrupted transient equals an uninterrupted one.

A bar against its stop and two half-spaces that roll into creepage are stopped by SIGTERM and SIGINT, killed by SIGKILL
at random moments (also before the first checkpoint and while one is written: they write all the time), resumed, and
compared: histories and sounds bit for bit on the same number of ranks, to 1e-9 from one rank to two. Further: a later end time, and
what --resume refuses. VIBROCONTACT_KILLS=20 in the environment: so many kills per scene instead of 2.

interrupted.py PROGRAM MPIRUN PARAMETER_FILES SCENE SETTING...: kills and ranks of another example, e.g. curve_squeal.
"""
import glob, json, os, random, signal, subprocess, sys, time

from h5py_of_system import h5py

program, mpirun, files = sys.argv[1:4]
n_kills = int(os.environ.get("VIBROCONTACT_KILLS", "2"))
random.seed(1)


def fail(text):
    sys.exit("FAILED: " + text)


def results(folder):
    return json.load(open(folder + "/results.json"))


def histories(folder):
    columns = {}
    for part in ("histories", "signals"):
        if os.path.exists(f"{folder}/{part}.h5"):
            with h5py.File(f"{folder}/{part}.h5") as file:
                columns.update({f"{part}/{name}": file[name][:] for name in file})
    return columns


class Scene:
    def __init__(self, name, *settings, label=None):
        self.name = label or name
        self.command = [program, f"{files}/examples/{name}.prm", "--quiet"]
        for setting in (*settings, "Transient/Checkpoint interval=1e-9", "Output/Figures=false", "Output/Fields=false"):
            self.command += ["--set", setting]
        begin = time.time()
        self.run("whole")
        self.duration = time.time() - begin
        self.whole = histories(self.folder("whole"))
        if glob.glob(self.folder("whole") + "/*.rows"):
            fail("the rows are left behind")

    def folder(self, case):
        return f"{self.name}_{case}"

    def run(self, case, *options, ranks=1, code=0):
        words = ([mpirun, "-n", str(ranks)] if ranks > 1 else []) + self.command + ["--output", self.folder(case), *options]
        done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        if done.returncode != code:
            fail(f"exit code {done.returncode} instead of {code}: {' '.join(words)}\n{done.stderr}")
        return done.stderr

    def interrupt(self, case, with_signal, delay, *options):
        """@param delay seconds; None: until the first checkpoint of a new run is there"""
        process = subprocess.Popen(self.command + ["--output", self.folder(case), *options], stderr=subprocess.DEVNULL)
        if delay is None:
            while process.poll() is None and not os.path.exists(self.folder(case) + "/checkpoint.h5"):
                time.sleep(1e-3)
        else:
            time.sleep(delay)
        process.send_signal(with_signal)
        return process.wait()

    def resume(self, case):
        # before the folder is made there is nothing to resume
        return ["--resume"] if os.path.exists(self.folder(case) + "/results.json") else []

    def check(self, case):
        for column, values in histories(self.folder(case)).items():
            if values.tobytes() != self.whole[column].tobytes():
                fail(f"{self.folder(case)}: {column} differs")
        for sound in glob.glob(self.folder("whole") + "/*.wav"):
            if open(sound, "rb").read() != open(f"{self.folder(case)}/{os.path.basename(sound)}", "rb").read():
                fail(f"{self.folder(case)}: {os.path.basename(sound)} differs")
        now, before = results(self.folder(case)), results(self.folder("whole"))
        if not now["complete"] or now["status"] != "converged":
            fail(f"{self.folder(case)}: not complete")
        for part in ("energy", "last", "steps", "impulse_Ns", "estimated_error", "estimated_error_rms_force", "modes"):
            if now["analyses"]["transient"].get(part) != before["analyses"]["transient"].get(part):
                fail(f"{self.folder(case)}: {part} differs")
        if set(now["analyses"]) != set(before["analyses"]):
            fail(f"{self.folder(case)}: an analysis is lost")

    def stop(self, with_signal):
        """Stopped in the middle, then resumed."""
        case = f"signal_{with_signal}"
        code = self.interrupt(case, with_signal, None)
        if code != 128 + with_signal:
            fail(f"exit code {code} after signal {with_signal}")
        if not results(self.folder(case)).get("interrupted") or results(self.folder(case))["complete"]:
            fail("results.json does not say that the run was interrupted")
        for signal_of_run in results(self.folder(case))["analyses"].get("transient", {}).get("signals", []):
            sound = signal_of_run.get("sound")
            if sound and not os.path.exists(f"{self.folder(case)}/{sound['file']}"):
                fail(f"there is no {sound['file']}")
        n = len(histories(self.folder(case))["histories/time_s"])
        if not 0 < n < len(self.whole["histories/time_s"]):
            fail(f"{n} lines in the histories of an interrupted run")
        self.run(case, "--resume")
        self.check(case)

    def kill(self):
        """Kills follow each other in one folder."""
        met = 0
        for k in range(n_kills):
            met += self.interrupt("killed", signal.SIGKILL, random.uniform(0.1, 0.3 + 1.5 * self.duration / n_kills),
                                  *self.resume("killed")) != 0
        self.run("killed", *self.resume("killed"))
        self.check("killed")
        print(f"{self.name}: {met} of {n_kills} kills met the run; histories equal bit for bit")

    def more_ranks(self, tolerance=1e-9):
        self.interrupt("ranks", signal.SIGKILL, None)
        self.run("ranks", *self.resume("ranks"), ranks=2)
        others = histories(self.folder("ranks"))
        for column, b in self.whole.items():
            values = others[column]
            if len(values) != len(b) or abs(values - b).max() > tolerance * abs(b).max():
                fail(f"{self.name}, 1 -> 2 ranks: {column} differs")


if len(sys.argv) > 4:
    scene = Scene(*sys.argv[4:])
    scene.kill()
    scene.more_ranks()
    sys.exit()

bar = Scene("bouncing_bar", "Transient/End time=8", "Transient/Signals/Probes=top: bar 0 0 10 along z",
            "Transient/Signals/Sound full scale=1")
if not glob.glob(bar.folder("whole") + "/top_velocity.wav") or glob.glob(bar.folder("whole") + "/*.part"):
    fail("the sound is not there, or only in part")
bar.stop(signal.SIGTERM)
bar.stop(signal.SIGINT)
bar.kill()
bar.more_ranks()

# the loading before a march is gone through again by the run that resumes
joint = Scene("lap_joint", "Transient/End time=0.006")
joint.stop(signal.SIGTERM)
joint.more_ranks()

# a run that is stopped early goes on to an earlier end, beyond the middle of which it is already
bar.interrupt("earlier", signal.SIGTERM, None)
reached = results(bar.folder("earlier"))["analyses"]["transient"]["time_s"]
bar.run("earlier", "--resume", "--set", f"Transient/End time={1.5 * reached}")
for column, values in histories(bar.folder("earlier")).items():
    if column.startswith("histories/") and values.tobytes() != bar.whole[column][:len(values)].tobytes():
        fail(f"{bar.folder('earlier')}: {column} differs")

# a run that came to its end goes on to a later one
bar.run("later", "--set", "Transient/End time=4")
bar.run("later", "--resume")
bar.check("later")
# errors are those of the last quarter, whatever the first end was
whole, later = (results(bar.folder(case))["analyses"]["transient"] for case in ("whole", "later"))
for key in ("estimated_error", "estimated_error_rms_force"):
    if not abs(later[key] - whole[key]) <= 1e-9 * whole[key]:
        fail(f"{key} is {later[key]} with a later end, {whole[key]} at once")
# what is refused, in one sentence, without harm
for setting, text in (("Transient/Theta=0.6", "Transient/Theta"), ("Transient/End time=1", "End time"),
                      ("Contact/Friction coefficient=0.123", "Contact/Friction coefficient"),
                      ("bar/Bar/Length=11", "bar/Bar/Length")):
    message = bar.run("later", "--resume", "--set", setting, code=1)
    # the machine may earn a warning about its BLAS above
    if not message.splitlines()[-1].startswith("vibrocontact: ") or text not in message.splitlines()[-1]:
        fail(f"refused with: {message}")
bar.check("later")
# a file that an entry names has changed
curve = os.path.abspath(bar.folder("curve") + ".csv")
for force, resumed, code in ((1e5, False, 0), (2e5, True, 1), (1e5, True, 0)):
    with open(curve, "w") as file:
        file.write(f"gap_m,force_N\n0,0\n-0.1,{force}\n")
    message = bar.run("curve", "--set", "Contact/Normal law=spring curve", "--set", f"Contact/Spring curve={curve}",
                      *(["--resume"] if resumed else []), code=code)
    if code == 1 and "Contact/Spring curve names a file that has changed" not in message.splitlines()[-1]:
        fail(f"another curve is refused with: {message}")
sound = bar.folder("later") + "/top_velocity.wav"
os.rename(sound, "moved.wav")
message = bar.run("later", "--resume", code=1)
if "samples of the sound" not in message.splitlines()[-1]:
    fail(f"a sound that is gone is refused with: {message}")
os.rename("moved.wav", sound)
checkpoint = bar.folder("later") + "/checkpoint.h5"
content = open(checkpoint, "rb").read()
open(checkpoint, "wb").write(content[:len(content) // 2])
message = bar.run("later", "--resume", code=1)
if "is damaged or incomplete" not in message.splitlines()[-1]:
    fail(f"a torn checkpoint is refused with: {message}")
open(checkpoint, "wb").write(content)
bar.run("later", "--resume")
bar.check("later")

rolling = Scene("rolling_transient", "Contact/Grid spacing=2e-3", "Transient/Time step=1e-5", "Transient/End time=4e-3", "Transient/Residual theta=0.6")
rolling.kill()
rolling.more_ranks()

# all modes of the elements are computed again by the run that resumes
elements = Scene("sliding_layer", "Analyses=transient", "layer/Modes/Count=20", "layer/Layer/Divisions x=8",
                 "layer/Layer/Divisions z=4", "Transient/End time=1e-3", "Transient/Perturbation velocity=1e-4")
elements.kill()
# forces of points with mass are differences of velocities over 1e-7 s, and theta = 1/2 keeps their round-off; a gap of
# closed points is round-off itself
elements.whole.pop("histories/smallest_gap_m")
elements.more_ranks(1e-7)

adapted = Scene("bouncing_bar", "Transient/End time=10", "Transient/Time step=0.032", "Transient/Error tolerance=1e-5",
                "Transient/Shortest time step=6.25e-5", label="adapted_steps")
adapted.stop(signal.SIGTERM)

# a run that failed goes on once its reason is gone, and nothing of the failure is left
def drive_table(force):
    open("drive.csv", "w").write(f"time_s, normal_force_N\n0, 66000\n2.6e-3, 66000\n2.9e-3, {force}\n4e-3, {force}\n")


drive_table(33000)
failing = Scene("rolling_transient", "Contact/Grid spacing=2e-3", "Transient/Time step=1e-5", "Transient/End time=4e-3",
                "Transient/Drive table=drive.csv", label="failed")
drive_table(9e6)  # the contact leaves its grid
failing.run("mended", code=2)
failed = results(failing.folder("mended"))
if failed["status"] != "not converged" or not failed["messages"] or "transient" in failed["finished"]:
    fail("results.json does not say that the transient did not converge")
drive_table(33000)
failing.run("mended", "--resume")
failing.check("mended")
if "messages" in results(failing.folder("mended")) or "not_converged" in results(failing.folder("mended")):
    fail("messages of the failure are left in results.json")
