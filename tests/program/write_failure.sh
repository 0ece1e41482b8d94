# Results that cannot be written: exit code 3, one sentence, no rank hangs, and what was written stays, marked incomplete.
program=$1 mpirun=$2 files=$3
fail() { echo "FAILED: $*"; cat message; exit 1; }
for ranks in 1 2; do
  rm -rf results
  # a folder stands where the second patch is to go: as a full disk, that meets rank 0 alone and in the middle of the run
  mkdir -p results/contact_patch_1.csv/x
  code=0
  timeout 60 "$mpirun" -n $ranks "$program" "$files/examples/half_space_rolling.prm" --quiet --output results \
    --set "Rolling/Sweep/Lateral creepage=0.001, 0.002, 0.003" >/dev/null 2>message || code=$?
  [ $code = 3 ] || fail "exit code $code instead of 3 on $ranks ranks"
  grep -q 'vibrocontact: the file "results/contact_patch_1.csv" cannot be written' message || fail "no such sentence"
  if grep -q "MPI_ABORT\|(rank" message; then fail "a rank was aborted"; fi
  [ -f results/contact_patch_0.csv ] || fail "the first patch is gone"
  grep -q '"complete": false' results/results.json || fail "results.json does not say that it is incomplete"
  grep -q '"status": "not converged"' results/results.json || fail "results.json has another status"
  grep -q '"lateral_creepage": 0.001' results/results.json || fail "results.json lacks the first case"
done

# files that may not grow beyond 16 blocks, as on a full disk: rows, checkpoints and histories meet that at different moments
for settings in "Transient/Checkpoint interval=1e-9" "Transient/Checkpoint interval=0" "Transient/Time step=2e-4"; do
  rm -rf small
  code=0
  (trap '' XFSZ; ulimit -f 16; exec timeout 60 "$program" "$files/examples/bouncing_bar.prm" --quiet --output small \
    --set "Output/Figures=false" --set "$settings" >/dev/null 2>message) || code=$?
  [ $code = 3 ] || fail "exit code $code instead of 3 with $settings"
  grep -q 'vibrocontact: the file "small/.*" cannot be written' message || fail "no such sentence with $settings"
done
