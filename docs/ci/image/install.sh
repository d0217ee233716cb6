#!/bin/sh
# install.sh full|small DEBS: makes a clean Debian 12 into the image, with raingauge's packages from the folder DEBS.
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
    raingauge*) name=$(ls "$2/${name}"_*.deb) ;;
  esac
  packages="$packages $name"
done
apt-get update
DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends $packages
downloads=$(mktemp -d)
sed -n '/^#/d; / \./p' packages.txt | while read -r name file; do
  (cd "$downloads" && apt-get download "$name")
  dpkg-deb --fsys-tarfile "$downloads/$name"_*.deb | tar -x -C / "$file"
done
rm -r "$downloads"
rm -rf /var/lib/apt/lists/* /var/cache/apt/*.bin /var/cache/apt/archives/*.deb /var/cache/debconf/*-old /var/log/apt /var/log/dpkg.log
