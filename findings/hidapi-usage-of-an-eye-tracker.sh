#!/usr/bin/env bash
# hidapi 0.13.1 (Debian 12's libhidapi-hidraw0): hid_enumerate() lists a valid eye tracker under the usage
# page of something else, so that who looks for eye trackers by usage finds none.
#
# The page of eye and head trackers is 0x12, the eye tracker its usage 1. A descriptor may say so in one
# item of four bytes, whose upper half is the page (HID 1.11, 6.2.2.8); hidapi keeps the lower half: the
# same device is on page 0, or on page 1 if an item for that stands before it, where usage 1 is a mouse's
# pointer. A page kept by Push and brought back by Pop (6.2.2.7) is not brought back: of a headset with
# an orientation sensor before the tracker, both are on the sensor's page. A usage of a collection inside
# is listed as one more device of the same path. hidapi.h says none of it, and no error is raised.
# Linux itself reads all of these right. Enumerate by vendor or take every path, and read the usages from
# the report descriptor (in sysfs, or by HIDIOCGRDESC) with a parser that knows global state.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"
apt-get download -q libhidapi-hidraw0=0.13.1-1 libhidapi-dev=0.13.1-1 umockdev=0.17.16-1 \
    libumockdev0=0.17.16-1 >/dev/null 2>&1
for package in ./*.deb; do
    dpkg-deb -x "$package" root
done
library=$folder/root/usr/lib/x86_64-linux-gnu
export LD_LIBRARY_PATH=$library

cat >list.c <<'CODE'
#include <hidapi.h>
#include <stdio.h>

int main(void) {
    struct hid_device_info* all = hid_enumerate(0, 0);
    for (struct hid_device_info* one = all; one != NULL; one = one->next) {
        printf("%s%02hx:%02hx", one == all ? "" : " ", one->usage_page, one->usage);
    }
    hid_free_enumeration(all);
    return 0;
}
CODE
gcc list.c -Iroot/usr/include/hidapi "$library/libhidapi-hidraw.so.0" -o list

unexpected=0
# expect WHAT STATED DESCRIPTOR: what hidapi lists of a USB device with that report descriptor.
expect() {
    cat >device.umockdev <<DEVICE
P: /devices/usb1
E: SUBSYSTEM=usb
E: DEVTYPE=usb_device
A: bcdDevice=0100

P: /devices/usb1/hid0
E: SUBSYSTEM=hid
A: uevent=HID_ID=0003:00001209:00000001\nHID_NAME=Tracker\nHID_UNIQ=1\n

P: /devices/usb1/hid0/hidraw/hidraw0
N: hidraw0
E: SUBSYSTEM=hidraw
H: device/report_descriptor=${3// /}
DEVICE
    local found
    found=$(root/usr/bin/umockdev-run --device device.umockdev -- ./list)
    printf '%-56s %s\n' "$1" "$found"
    [[ $found == "$2" ]] || unexpected=1
}
echo 'usage page:usage as listed by hidapi (an eye tracker is 12:01)'
value='15 00 25 7F 75 08 95 01 81 02' # a byte of input
expect 'page, usage' 12:01 "05 12 09 01 A1 01 09 20 $value C0"
expect 'one usage of four bytes' 00:01 "0B 01 00 12 00 A1 01 05 12 09 20 $value C0"
expect 'the same after an item for page 1' 01:01 "05 01 0B 01 00 12 00 A1 01 05 12 09 20 $value C0"
expect 'page 12, Push, sensor on page 20, Pop, eye tracker' '20:8a 20:01' \
    "05 12 A4 05 20 09 8A A1 01 09 30 $value C0 B4 09 01 A1 01 09 20 $value C0"
expect 'one eye tracker with a collection inside' '12:01 12:20' \
    "05 12 09 01 A1 01 09 20 A1 00 09 21 $value C0 C0"
if ((unexpected)); then
    echo 'NOT as stated: this finding is out of date'
    exit 1
fi
echo 'as stated'
