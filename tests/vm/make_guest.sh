#!/usr/bin/env bash
# make_guest.sh OUT KERNEL RULES PROGRAM...: the virtual machine's first file system, as a cpio
# archive OUT: BusyBox, udevd, the software Vulkan driver, the kernel's modules from the folder
# KERNEL, the udev rules that gazeloop ships, and the programs, with all libraries they need.
set -euo pipefail
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
out=$1 kernel=$2 rules=$3
shift 3
driver=/usr/lib/x86_64-linux-gnu/libvulkan_lvp.so

root=$(mktemp -d)
trap 'rm -rf -- "$root"' EXIT
chmod 755 "$root"
mkdir -p "$root"/{bin,dev,etc/udev/rules.d,lib/udev/rules.d,modules,proc,run,sys,tmp}
cp -- "$(command -v busybox)" "$root/bin/busybox"
cp -- /bin/udevadm "$@" "$root/bin/"
ln -s udevadm "$root/bin/systemd-udevd" # one program, which looks at its name
cp -- /lib/udev/rules.d/50-udev-default.rules "$root/lib/udev/rules.d/"
cp -- "$rules" "$root/shipped.rules"
cp -- "$kernel"/modules/* "$root/modules/"
cp -- "$here/guest_init" "$root/init"
cp -- "$here/guest_checks" "$root/checks"
chmod +x "$root/init"
printf 'root:x:0:0::/:/bin/sh\nuser:x:1000:1000::/tmp:/bin/sh\n' >"$root/etc/passwd"
printf 'root:x:0:\ninput:x:104:\nuser:x:1000:\n' >"$root/etc/group"

files=("$driver" /usr/share/vulkan/icd.d/lvp_icd.x86_64.json)
mapfile -t -O 2 files < <(ldd /bin/udevadm "$driver" "$@" | awk '
    $2 == "=>" && $3 == "not" { print "missing: " $1 >"/dev/stderr"; exit 1 }
    $2 == "=>" { print $3 }
    $1 ~ /^\// && $2 ~ /^\(/ { print $1 }' | sort -u)
for file in "${files[@]}"; do
    mkdir -p "$root$(dirname -- "$file")"
    cp -L -- "$file" "$root$file"
done
(cd "$root" && find . | busybox cpio -o -H newc 2>/dev/null) >"$out"
