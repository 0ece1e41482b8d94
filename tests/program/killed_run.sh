# A run that is killed leaves a folder that says so.
program=$1 files=$3
# what Open MPI leaves of a killed process stays here
export TMPDIR=$PWD
"$program" "$files/examples/creep_curves.prm" --quiet --output results --set "Contact/Grid spacing=0.5e-3" \
  --set Output/Figures=false &
process=$!
for trial in $(seq 600); do
  [ -f results/contact_patch_0.csv ] && break
  sleep 0.1
done
kill -9 $process
wait $process 2>/dev/null || true
fail() { echo "FAILED: $*"; ls results; exit 1; }
grep -q '"complete": false' results/results.json || fail "results.json does not say that it is incomplete"
grep -q '"status": "not converged"' results/results.json || fail "results.json has another status"
