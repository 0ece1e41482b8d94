"""All studies, one module per family; a new family is one line here."""
from . import convolution, creep, identification, limit_cycles, periodic, ranks, reduction, solvers, stability, transient

FAMILIES = [creep, solvers, reduction, stability, transient, limit_cycles, convolution, periodic, identification, ranks]
ALL = [study for family in FAMILIES for study in family.STUDIES]
