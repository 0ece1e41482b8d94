"""Contact solvers over the stored problems and over steps of few points."""
from study import Point, Study

SETS = {  # name of the set in the executable: title, cost, solvers that take it
    "half-space": ("stored problems of half-spaces", "all problems, from no start",
                   ["automatic", "semi-smooth newton", "fixed point"]),
    "elements": ("stored problems of finite elements", "all problems, from no start",
                 ["automatic", "semi-smooth newton", "fixed point"]),
    "road": ("4000 steps of 30 points without friction", "all steps, each from the one before",
             ["automatic", "active set", "semi-smooth newton", "fixed point"]),
    "few": ("4000 steps of 4 points with friction", "all steps, each from the one before",
            ["automatic", "few points", "semi-smooth newton", "fixed point"])}


def points(name):
    """Function that measures one set; tolerance 1e-10 is the default one."""
    def measure(bench):
        found = []
        rows = bench.executable("stored_problems_benchmark", min(3, bench.repetitions), name, "quick" if bench.quick else "full")
        for _, solver, tolerance, error, *seconds in rows:
            found.append(Point(f"{solver}, tolerance {tolerance}", solver, [float(one) for one in seconds], float(error),
                               solver == "automatic" and float(tolerance) == 1e-10, {"Contact/Solver/Method": solver}))
        return found
    return measure


STUDIES = [Study(
    name="solvers_" + name.replace("-", "_"), title="Contact solvers: " + title,
    truth="the fixed point to a residual of 1e-12, and for the fixed point itself Newton's method to 1e-12: they share nothing but the "
          "residual.", cost=f"processor time of {cost} [s]", error="largest relative error of the forces [-]", floor=1e-9,
    choices={"Contact/Solver/Method": solvers}, measure=points(name)) for name, (title, cost, solvers) in SETS.items()]
