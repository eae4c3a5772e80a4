#!/usr/bin/env bash
# Installs the Debian 12 packages that building, running and testing need; does nothing when all are there.
# Usage: scripts/install_packages.sh [MORE_PACKAGES...]      as root, or with sudo at hand. Exit code 3 when it cannot.
set -euo pipefail

packages=(
    # the build
    g++ cmake ninja-build pkg-config git python3-glad
    # what the program stands on
    libglm-dev nlohmann-json3-dev libfmt-dev libcli11-dev libpng-dev libopenexr-dev libtbb-dev
    libtinygltf-dev libstb-dev libxxhash-dev libegl-dev
    # GL at run time: EGL with Mesa's drivers, and OSMesa, which is opened with dlopen
    libegl1 libegl-mesa0 libgl1-mesa-dri libosmesa6
    # tests and benchmarks
    libgtest-dev libgmock-dev libbenchmark-dev
    # plots, and the check of reports
    python3-matplotlib python3-jsonschema
)

is_installed() { dpkg-query --show --showformat='${db:Status-Status}\n' "$1" 2>/dev/null | grep -qx installed; }

refuse() {
    echo "install_packages.sh: $1; needed: ${missing[*]}" >&2
    exit 3
}

missing=()
for package in "${packages[@]}" "$@"; do
    is_installed "$package" || missing+=("$package")
done
[[ ${#missing[@]} -gt 0 ]] || exit 0

command -v apt-get >/dev/null || refuse "there is no apt-get here"
as_root=()
if [[ $EUID -ne 0 ]]; then
    command -v sudo >/dev/null || refuse "packages are missing, and this is neither root nor is there sudo"
    as_root=(sudo)
fi
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300)

echo "installing ${missing[*]}" >&2
# A third-party source that is down must not stop what Debian's own mirrors can give.
"${apt[@]}" update >&2 || echo "install_packages.sh: apt-get update failed; going on with the lists there are" >&2
"${apt[@]}" install --yes --no-install-recommends "${missing[@]}" >&2 || refuse "apt-get failed"
