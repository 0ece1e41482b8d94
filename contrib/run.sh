#!/bin/bash
# run.sh [-n RANKS] FILE.prm [options]: runs build/vibrocontact under mpirun, also as root and with more ranks than cores;
# says so when a rank was killed, as the system does when memory runs out.
ranks=2
[ "$1" = -n ] && { ranks=$2; shift 2; }
program=${VIBROCONTACT:-$(dirname "$0")/../build/vibrocontact}
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
# one BLAS thread per rank
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
# behind mpirun a rank cannot see where its lines go
[ -t 1 ] && export VIBROCONTACT_TERMINAL=yes
# one rank needs no mpirun
command=("$program" "$@")
[ "$ranks" = 1 ] || command=(mpirun -q --oversubscribe --bind-to none -n "$ranks" "${command[@]}")

# in a group of its own, so that each signal reaches it once, through here
set -m
"${command[@]}" </dev/null &
child=$!
# to the ranks themselves: mpirun would pass it on, kill them a moment later and end with 1, as if the input were wrong
to_ranks() {
  local processes=$child
  [ "$ranks" = 1 ] || processes=$(cat "/proc/$child/task/$child/children")
  kill -"$1" ${processes:-$child} 2>/dev/null
}
for signal in INT TERM HUP; do
  trap "to_ranks $signal" $signal
done
while kill -0 $child 2>/dev/null; do
  wait $child 2>/dev/null
done
wait $child 2>/dev/null
code=$?
if [ $code = 137 ]; then
  echo "run.sh: a rank was killed (signal 9), as the system does when memory runs out; $(awk '/^MemAvailable/ \
    {printf "%.1f", $2 * 1.024e-6}' /proc/meminfo) GB are free now. --check says how much a file needs. Take one rank" \
    "(-n 1), a coarser mesh or a lower degree, a beam rail in place of a solid one, or a larger machine." >&2
fi
exit $code
