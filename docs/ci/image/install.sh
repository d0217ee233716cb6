#!/bin/sh
# install.sh full|small: makes a clean Debian 12 into the image. Beside it lie packages.txt, dpkg.cfg and raingauge's packages.
set -e
cd "$(dirname "$0")"
case $1 in
  full) kept='s/ full$//' ;;
  small) kept='/ full$/d' ;;
  *) echo "install.sh: '$1': choose full or small" >&2; exit 2 ;;
esac
cp dpkg.cfg /etc/dpkg/dpkg.cfg.d/zz-raingauge
packages=
for name in $(sed "/^#/d; / \./d; $kept" packages.txt); do
  case $name in
    raingauge*) name=$(ls "$PWD/${name}"_*.deb) ;;
  esac
  packages="$packages $name"
done
apt-get update
DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends $packages
sed -n '/^#/d; / \./p' packages.txt | while read -r name file; do
  apt-get download "$name"
  dpkg-deb --fsys-tarfile "$name"_*.deb | tar -x -C / "$file"
done
rm -rf /var/lib/apt/lists/* /var/cache/apt/*.bin /var/cache/apt/archives/*.deb /var/cache/debconf/*-old /var/log/apt /var/log/dpkg.log
