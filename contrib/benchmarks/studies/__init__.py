"""All studies, one module per family; a new family is one line here."""
from . import creep

ALL = [*creep.STUDIES]
