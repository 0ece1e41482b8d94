#!/bin/bash
# run.sh [-n RANKS] FILE.prm [options]: runs build/vibrocontact under mpirun, also as root and with more ranks than cores.
ranks=2
[ "$1" = -n ] && { ranks=$2; shift 2; }
program=${VIBROCONTACT:-$(dirname "$0")/../build/vibrocontact}
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
# one BLAS thread per rank
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
# one rank needs no mpirun
[ "$ranks" = 1 ] && exec "$program" "$@"
exec mpirun -q --oversubscribe --bind-to none -n "$ranks" "$program" "$@"
