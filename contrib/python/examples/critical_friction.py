"""From which friction on does a sliding layer squeal below 11 kHz? Bisection over runs of its stability.

usage: critical_friction.py [FOLDER]
"""
import sys

import vibrocontact as vc

LIMIT_HZ = 11000
folder = sys.argv[1] if len(sys.argv) > 1 else "results/critical_friction"
case = vc.Case.from_file(vc.EXAMPLES / "sliding_layer.prm", {"Analyses": "stability", "Stability/Model": "reduced"})


def growth(results: vc.Results) -> float:
    """Of the fastest root below the limit [1/s]; 0 if none grows."""
    unstable = results.analyses.stability.unstable
    return max((root.growth_1_s for root in unstable if root.frequency_Hz < LIMIT_HZ), default=0.0)


squeal = vc.Objective(case, ["Contact/Friction coefficient"], growth, folder)
stable, unstable = 0.1, 0.4
assert squeal(stable) == 0 and squeal(unstable) > 0
while unstable - stable > 0.02:
    middle = (stable + unstable) / 2
    if squeal(middle) > 0:
        unstable = middle
    else:
        stable = middle
    print(f"friction {middle:.4f}: growth {squeal(middle):7.1f} 1/s")
print(f"below {LIMIT_HZ} Hz the layer squeals from a friction between {stable:.4f} and {unstable:.4f} on ({len(squeal.history)} runs)")
