# Frequencies of a sphere and an annular plate that are meshed from STEP files against closed forms: errors and orders.
python3 -B "$3/verification/step_part/run.py" "$1" --quick
