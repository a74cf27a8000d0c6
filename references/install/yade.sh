#!/bin/sh
# Installs YADE from Debian's packages (some 1.2 GB). Does nothing where it is installed already.
set -eu
if command -v yade > /dev/null; then
    echo "YADE is installed: $(command -v yade)"
    exit 0
fi
command -v apt-get > /dev/null || { echo "no apt-get: this script is for Debian; install YADE as your system does" >&2; exit 1; }
[ "$(id -u)" = 0 ] || { echo "installing packages needs root: run it with sudo" >&2; exit 1; }
export DEBIAN_FRONTEND=noninteractive
apt-get update
apt-get install -y --no-install-recommends yade
command -v yade > /dev/null || { echo "the package is installed, but there is no command 'yade'" >&2; exit 1; }
echo "YADE is ready"
