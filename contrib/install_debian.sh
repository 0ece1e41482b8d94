#!/bin/bash
# Installs what Vibrocontact needs on Debian 12: compiler, deal.II with PETSc, SLEPc and p4est, OpenBLAS, gmsh with its library, and for
# tests and figures GoogleTest and matplotlib. As root, or with sudo. Does nothing if all is there.
set -e
packages="
  build-essential cmake ninja-build git ca-certificates pkg-config
  libdeal.ii-dev mpi-default-bin mpi-default-dev
  libopenblas0-pthread
  nlohmann-json3-dev libboost-program-options-dev libfftw3-dev libsndfile1-dev
  gmsh libgmsh-dev
  libgtest-dev
  python3 python3-numpy python3-matplotlib python3-h5py python3-pandas python3-meshio
"
missing=$(for p in $packages; do
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$p" 2>/dev/null)" = installed ] || echo "$p"
done)
[ -n "$missing" ] || exit 0

as_root=
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null || { echo "install_debian.sh: run it as root, or install sudo" >&2; exit 1; }
  as_root=sudo
fi
echo "installing:" $missing
export DEBIAN_FRONTEND=noninteractive
apt="$as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 -o Dpkg::Options::=--force-unsafe-io"
$apt update
$apt install -y --no-install-recommends $missing >/dev/null
