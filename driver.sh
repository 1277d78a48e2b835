#!/usr/bin/env bash
# Sees to it that there is a Vulkan driver for render-check: where none is installed, Debian's software one.
set -euo pipefail

if [ "$(uname)" = Darwin ] || [ -n "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ]; then
    exit 0
fi
for folder in /usr/share/vulkan/icd.d /usr/local/share/vulkan/icd.d /etc/vulkan/icd.d; do
    if compgen -G "$folder/*.json" >/dev/null; then
        exit 0
    fi
done
if ! command -v apt-get >/dev/null; then
    echo 'no Vulkan driver: install one; Mesa has one in software, lavapipe, for machines without a graphics card' >&2
    exit 1
fi
as_root=()
if [ "$(id --user)" != 0 ]; then
    as_root=(sudo)
fi
"${as_root[@]}" apt-get update
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends mesa-vulkan-drivers
