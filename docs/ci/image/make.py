#!/usr/bin/env python3
"""Makes an image of raingauge for containers, without Docker: make.py [full|small] --debs FOLDER -o FILE, with network.

FOLDER has raingauge's Debian packages, as `make deb` leaves them in build/deb. mmdebstrap makes a Debian 12, and install.sh installs
what packages.txt lists: `full` is everything, `small` lacks PoCL and OpenImageIO. FILE becomes an OCI archive, which `podman load`,
`docker load` and `apptainer build raingauge.sif oci-archive:FILE` read. Prints the image's size packed, as it is pulled, and unpacked.
Fails if one exceeds its limit.
"""
import argparse
import gzip
import hashlib
import io
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
MB = 1000 * 1000
# The most bytes that each may have: packed, unpacked.
LIMITS = {"full": (400 * MB, 1300 * MB), "small": (400 * MB, 450 * MB)}
ARCHITECTURES = {"x86_64": "amd64", "aarch64": "arm64"}
BLOCK = 4096
# Of mmdebstrap: usr-is-merged takes the place of usrmerge, which needs all of Perl.
MERGED_USR = "/usr/share/mmdebstrap/hooks/merged-usr"


def make_tree(variant, debs, to, options):
    """Writes a tar archive of the root file system."""
    with tempfile.TemporaryDirectory() as folder:
        for path in [HERE / name for name in ("install.sh", "packages.txt", "dpkg.cfg")] + debs:
            shutil.copy(path, folder)
        hooks = ['mkdir "$1/tmp/image"', f'cp {folder}/* "$1/tmp/image"', f'chroot "$1" sh /tmp/image/install.sh {variant} /tmp/image',
                 'rm -r "$1/tmp/image"']
        command = ["mmdebstrap", "--variant=apt", "--include=usr-is-merged", f"--hook-dir={MERGED_USR}", f"--dpkgopt={HERE / 'dpkg.cfg'}"]
        command += ["--customize-hook=" + hook for hook in hooks] + ["--aptopt=" + option for option in options.apt]
        command += ["bookworm", str(to)] + options.mirror
        subprocess.run(command, stdout=sys.stderr, check=True)


def unpacked_bytes(tree):
    """What `du` counts of the tree: whole blocks, and a file of several names once."""
    with tarfile.open(tree) as tar:
        return sum(-(-member.size // BLOCK) * BLOCK if member.isreg() else BLOCK * member.isdir() for member in tar)


def settings():
    """Variables and command of the image, as the Containerfile has them."""
    text = (HERE / "Containerfile").read_text()
    return {"Env": ["PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"] + re.search(r"^ENV (.*)$", text, re.M)[1].split(),
            "Cmd": json.loads(re.search(r"^CMD (.*)$", text, re.M)[1])}


class Archive:
    """An OCI image layout in a tar archive; https://github.com/opencontainers/image-spec."""

    def __init__(self, path):
        self.tar = tarfile.open(path, "w")

    def put(self, name, data):
        info = tarfile.TarInfo(name)
        info.size = len(data)
        self.tar.addfile(info, io.BytesIO(data))

    def put_blob(self, data, kind):
        """Adds bytes by their digest, and returns the words that name them."""
        digest = hashlib.sha256(data).hexdigest()
        self.put("blobs/sha256/" + digest, data)
        return {"mediaType": f"application/vnd.oci.image.{kind}", "digest": "sha256:" + digest, "size": len(data)}


def write_archive(tree, tag, path):
    """Packs a tree into an OCI archive. Returns the packed layer's size."""
    data = tree.read_bytes()
    packed = gzip.compress(data, 6, mtime=0)
    architecture = ARCHITECTURES[subprocess.run(["uname", "-m"], stdout=subprocess.PIPE, text=True, check=True).stdout.strip()]
    config = {"architecture": architecture, "os": "linux", "config": settings(),
              "rootfs": {"type": "layers", "diff_ids": ["sha256:" + hashlib.sha256(data).hexdigest()]}}
    archive = Archive(path)
    layer = archive.put_blob(packed, "layer.v1.tar+gzip")
    config = archive.put_blob(json.dumps(config).encode(), "config.v1+json")
    manifest = {"schemaVersion": 2, "mediaType": "application/vnd.oci.image.manifest.v1+json", "config": config, "layers": [layer]}
    manifest = archive.put_blob(json.dumps(manifest).encode(), "manifest.v1+json")
    manifest["annotations"] = {"org.opencontainers.image.ref.name": tag, "io.containerd.image.name": "docker.io/library/" + tag}
    archive.put("oci-layout", b'{"imageLayoutVersion": "1.0.0"}')
    archive.put("index.json", json.dumps({"schemaVersion": 2, "manifests": [manifest]}).encode())
    archive.tar.close()
    return len(packed)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("variant", nargs="?", choices=LIMITS, default="full")
    parser.add_argument("--debs", type=pathlib.Path, required=True, metavar="FOLDER", help="has raingauge's Debian packages")
    parser.add_argument("-o", dest="output", type=pathlib.Path, required=True, metavar="FILE")
    parser.add_argument("--tree", type=pathlib.Path, metavar="FILE", help="keeps the root file system here, as a tar archive")
    parser.add_argument("--mirror", action="append", default=[], metavar="LINE", help="of apt's sources; Debian's own without it")
    parser.add_argument("--apt", action="append", default=[], metavar="OPTION", help="for apt, as 'Acquire::Check-Valid-Until \"false\"'")
    options = parser.parse_args()
    debs = [path for path in options.debs.glob("raingauge*.deb") if "-dbgsym_" not in path.name]
    if not debs:
        sys.exit(f"make.py: {options.debs}: has no package of raingauge; `make deb` makes them in build/deb")
    with tempfile.TemporaryDirectory(dir=options.output.resolve().parent) as folder:
        tree, made = options.tree or pathlib.Path(folder) / "tree.tar", pathlib.Path(folder) / "image.tar"
        make_tree(options.variant, debs, tree, options)
        sizes = (write_archive(tree, "raingauge:" + options.variant, made), unpacked_bytes(tree))
        excess = [word for word, size, limit in zip(("packed", "unpacked"), sizes, LIMITS[options.variant]) if size > limit]
        for word, size, limit in zip(("packed", "unpacked"), sizes, LIMITS[options.variant]):
            print(f"{options.variant}: {word} {size / MB:.0f} MB, of at most {limit // MB}")
        if excess:
            sys.exit(f"make.py: the image is too large {' and '.join(excess)}, and is not kept")
        made.rename(options.output)
    print(options.output)


if __name__ == "__main__":
    main()
