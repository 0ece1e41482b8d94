# A sweep of each analysis that takes one: see sweeps.py.
python3 "$(dirname "$0")/sweeps.py" "$@"
