# contrib/run.sh passes arguments, signals and exit codes on, and says so when a rank was killed.
files=$3
fail() { echo "FAILED: $*"; cat message; exit 1; }
cat > killed <<'END'
#!/bin/bash
[ "${OMPI_COMM_WORLD_RANK:-1}" = 1 ] && kill -9 $$
sleep 1
END
printf '#!/bin/bash\necho "$@"; exit 2\n' > ends
# what a march does that is stopped: it takes its time, then says by its exit code which signal it was
cat > stopped <<'END'
#!/bin/bash
trap 'sleep 3; touch wrote$OMPI_COMM_WORLD_RANK; exit 143' TERM
touch started$OMPI_COMM_WORLD_RANK
for i in $(seq 300); do sleep 0.1; done
END
chmod +x killed ends stopped
for ranks in 1 2; do
  code=0
  VIBROCONTACT=$PWD/killed bash "$files/../contrib/run.sh" -n $ranks case.prm >/dev/null 2>message || code=$?
  [ $code = 137 ] || fail "exit code $code instead of 137 on $ranks ranks"
  grep -q "a rank was killed (signal 9), as the system does when memory runs out" message || fail "nothing is said of it on $ranks ranks"
  code=0
  VIBROCONTACT=$PWD/ends bash "$files/../contrib/run.sh" -n $ranks case.prm --quiet >screen 2>message || code=$?
  [ $code = 2 ] || fail "exit code $code instead of 2 on $ranks ranks"
  grep -q "^case.prm --quiet" screen || fail "the arguments are not passed on"
  if grep -q "was killed" message; then fail "a run that ends is called killed"; fi
  code=0; rm -f started* wrote*
  VIBROCONTACT=$PWD/stopped bash "$files/../contrib/run.sh" -n $ranks case.prm >/dev/null 2>message &
  for i in $(seq 300); do [ "$(ls started* 2>/dev/null | wc -l)" = $ranks ] && break; sleep 0.1; done
  kill -TERM $!
  wait $! || code=$?
  [ $code = 143 ] || fail "exit code $code instead of 143 on $ranks ranks that are stopped"
  [ "$(ls wrote* | wc -l)" = $ranks ] || fail "ranks that are stopped are not let end"
done
