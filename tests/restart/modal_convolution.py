#!/usr/bin/env python3
"""modal_convolution.py PROGRAM MPIRUN PARAMETER_FILES: an interrupted modal convolution equals an uninterrupted one.

A tyre on three points by each stepping method, also with friction, one on hundreds by FFT, and the event-located oscillator are stopped by SIGTERM at random moments of their
march, resumed, and compared: histories and impulses bit for bit, also on two ranks. Further: an end before the checkpoint.
"""
import json, os, random, signal, subprocess, sys, time

from h5py_of_system import h5py

program, mpirun, files = sys.argv[1:4]
random.seed(1)


def fail(text):
    sys.exit("FAILED: " + text)


def content(folder):
    with h5py.File(folder + "/histories.h5") as file:
        columns = {name: file[name][:].tolist() for name in file}
    analysis = json.load(open(folder + "/results.json"))["analyses"]["modal_convolution"]
    for name in ("impacts", "releases", "impulse_Ns", "steps", "estimated_error", "estimated_error_rms_force", "rms_force_N",
                 "unseen_road_share", "energy"):
        columns[name] = analysis.get(name)
    return columns


def check(example, label, *settings):
    command = [program, f"{files}/examples/{example}.prm", "--quiet"]
    for setting in (*settings, "Modal convolution/Checkpoint interval=1e-9", "Output/Figures=false"):
        command += ["--set", setting]

    def run(case, *options, ranks=1):
        words = ([mpirun, "-n", str(ranks)] if ranks > 1 else []) + command + ["--output", f"{label}_{case}", *options]
        return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    begin = time.time()
    if run("whole").returncode != 0:
        fail(f"{label} does not run")
    duration = time.time() - begin
    whole = content(f"{label}_whole")
    interrupted = 0
    if run("two", ranks=2).returncode != 0 or content(f"{label}_two") != whole:
        fail(f"{label} differs on two ranks")
    for attempt in range(2):
        case = f"stopped{attempt}"
        process = subprocess.Popen(command + ["--output", f"{label}_{case}"], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        # on a busy machine the march may begin late
        while not os.path.exists(f"{label}_{case}/modal_convolution.h5") and process.poll() is None:
            time.sleep(0.001)
        time.sleep(duration * random.uniform(0, 0.25))
        process.send_signal(signal.SIGTERM)
        interrupted += process.wait() == 128 + signal.SIGTERM
        done = run(case, "--resume")
        if done.returncode != 0:
            fail(f"{label} does not resume: {done.stderr}")
        if content(f"{label}_{case}") != whole:
            fail(f"{label} differs after it was interrupted")
    if interrupted == 0:
        fail(f"{label} was over before it was interrupted")
    return command


short = "Modal convolution/End time=0.4"
for method in ("modal recursion", "direct convolution", "block convolution"):
    memory = [] if method == "modal recursion" else ["Modal convolution/Memory=0.02"]
    command = check("tyre_three_points", method.split()[0], short, f"Modal convolution/Method={method}", *memory)
check("tyre_three_points", "friction", short, "Modal convolution/Friction=true", "Road/Sliding speed=0.05",
      "tyre/Ring/Tread tangential stiffness=1e5")
check("tyre_three_points", "falling", short, "Modal convolution/Friction=true", "Road/Sliding speed=0.05",
      "tyre/Ring/Tread tangential stiffness=1e5", "Contact/Static friction ratio=1.4", "Modal convolution/Method=theta method")
check("tyre_rolling", "products", "Modal convolution/End time=0.1", "tyre/Ring/Contact points=200",
      "tyre/Ring/Contact spacing=6e-4", "tyre/Ring/Tread stiffness=20160")
check("oscillator_on_sine", "spring", "Modal convolution/Method=modal recursion", "Contact/Normal law=exponential penalty", "Contact/Penalty amplitude=1e3",
      "Contact/Penalty exponent=300", "Modal convolution/Force shape=constant", "Modal convolution/End time=2")
check("oscillator_on_sine", "events", "Modal convolution/End time=20")
done = subprocess.run(command + ["--set", "Modal convolution/End time=0.2", "--output", "block_whole", "--resume"],
                      stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
if done.returncode != 1 or "is before what the run to be resumed has reached" not in done.stderr:
    fail("an end before the checkpoint is not refused: " + done.stderr)
