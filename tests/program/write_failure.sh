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
