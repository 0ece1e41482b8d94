# Frequencies of a sphere, an annular plate and a cantilever by every type of cell of degree 2, against closed forms: errors and orders.
python3 -B "$3/verification/cell_types/run.py" "$1" --quick
