#!/bin/sh
# Runs a program as so many processes of MPI, on whatever processors there are: RANKS PROGRAM ARGUMENT...
set -eu
ranks=$1
shift
# Open MPI asks whoever is root to say so.
OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
  exec mpirun --oversubscribe --mca btl self,vader --mca mpi_yield_when_idle 1 -n "$ranks" "$@"
