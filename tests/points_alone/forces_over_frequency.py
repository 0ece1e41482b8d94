#!/usr/bin/env python3
"""forces_over_frequency.py PROGRAM MPIRUN PARAMETER_FILES: spectra of the contact force of both marches, by closed forms.

A mass on a spring follows a road u = h sin(2 pi s / L) at speed V without leaving it: the force swings by
|K - M w^2 + j w C| h at w = 2 pi V / L. Held by a rigid plane, it hands on what pushes it, F sin(w t).
"""
import json
import math

from scene import Check, entries, run, section, table

M, K, zeta, h, L, V, F = 1., 4e5, 0.02, 1e-5, 0.025, 2.5, 3.
f, step, end = V / L, 1e-4, 2.
w = 2 * math.pi * f
check = Check()
mass = section("mass", "set Type = oscillator", section("Oscillator", entries(Mass=M, Stiffness=K, Damping_ratio=zeta)))
expected = {"modal_convolution": h * abs(complex(K - M * w**2, w * 2 * zeta * math.sqrt(K * M))), "transient": F}
over_road = ["set Bodies = mass", mass, "set Analyses = modal convolution",
             section("Road", entries(Profile="expression", Expression=f"{h}*sin(2*pi*s/{L})", Speed=V, Indentation=1e-4)),
             section("Modal convolution", entries(Time_step=step, End_time=end, Method="modal recursion", Error_estimate="false"))]
pushed = ["set Bodies = mass, plane", mass, section("plane", "set Type = rigid"), "set Analyses = transient",
          section("Contact", entries(Friction_coefficient=0)), section("Rolling", entries(Hub_displacement=1e-4, Speed=0)),
          section("Transient", entries(Time_step=step, End_time=end, Error_estimate="false", Reaction="end of step",
                                       Exciting_force=f"{F}*sin({w}*t)"))]
for name, text, tolerance in (("modal_convolution", over_road, 2e-3), ("transient", pushed, 1e-3)):
    found, folder = run(name, "\n".join(text))
    found = found[name]
    signal = found["signals"][0]
    if signal["name"] != "normal_force":
        check.near("first signal", 0, 1, 0)
    check.near(f"{name}: frequency", found["dominant_frequencies_Hz"][0], f, 1e-4)
    check.near(f"{name}: amplitude of the peak", signal["peaks"][0]["amplitude"], expected[name], tolerance)
    check.near(f"{name}: amplitude of the cycle", signal["cycle"]["amplitude"], expected[name], tolerance)
    bands = table(folder, found["third_octaves"])
    rms = [band["rms_N"] for band in bands if band["lower_Hz"] < f < band["upper_Hz"]]
    check.near(f"{name}: rms of the band", rms[0], expected[name] / math.sqrt(2), tolerance)
# windows of a modal convolution: the same part of the run by hand
windows = section("Modal convolution", section("Signals", entries(Spectrum_duration=end / 4, Growth_begin=1, Growth_end=1.5)))
found, _ = run("windows", "\n".join(over_road + [windows]))
signal = found["modal_convolution"]["signals"][0]
for what, bounds in (("spectrum", (end - end / 4, end)), ("growth", (1, 1.5))):
    for got, at in zip(signal[f"{what}_window_s"], bounds):
        check.near(f"window of the {what}", got, at, 2 * step)
check.end()
