#!/bin/sh
# Installs CalculiX from Debian's packages. Does nothing where it is installed already.
set -eu
if command -v ccx > /dev/null; then
    echo "CalculiX is installed: $(command -v ccx)"
    exit 0
fi
command -v apt-get > /dev/null || { echo "no apt-get: this script is for Debian; install CalculiX as your system does" >&2; exit 1; }
[ "$(id -u)" = 0 ] || { echo "installing packages needs root: run it with sudo" >&2; exit 1; }
export DEBIAN_FRONTEND=noninteractive
apt-get update
apt-get install -y --no-install-recommends calculix-ccx
command -v ccx > /dev/null || { echo "the package is installed, but there is no command 'ccx'" >&2; exit 1; }
echo "CalculiX is ready"
