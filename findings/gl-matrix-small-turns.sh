#!/usr/bin/env bash
# gl-matrix 3.4.4 (npm; the usual mathematics of WebXR pages): between two directions less than .081
# degrees apart it finds no rotation, and of half of all orientations no angle to themselves.
#
# quat.rotationTo() takes any two directions whose cosine is over .999999 for one and gives back the
# identity, so a gaze or a head that moves by less than 1.41 milliradians between two samples does not
# move at all, in silence: a pursuit of 10 degrees per second at 120 Hz steps by .083 degrees, at 144 Hz
# by .069. Whoever adds such rotations up stands still; from .09 degrees on it is exact, to 1e-5.
# quat.getAngle() takes the arc cosine of 2 d^2 - 1. The product d of two unit quaternions in floats is
# often a bit over 1, and then the angle is NaN: for one orientation against itself in about half of all
# cases, and among the others it is up to .05 degrees. A mean error of a tracker, or a maximum by
# Math.max, is then NaN. vec3.angle() clamps its cosine, quat.getAngle() does not.
# Take 2 atan2(length of the product's vector part, its scalar part), and rotations from the cross
# product without a threshold; or switch to Array with glMatrix.setMatrixArrayType, which makes NaN
# rarer and leaves the threshold.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"
npm install --silent --no-audit --no-fund --prefix "$folder" gl-matrix@3.4.4 >/dev/null
cat >turns.js <<'CODE'
const { quat, vec3 } = require("gl-matrix");

let state = 1;
const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
const direction = () => {
    const z = 2 * random() - 1, turn = 2 * Math.PI * random(), r = Math.sqrt(1 - z * z);
    return [r * Math.cos(turn), r * Math.sin(turn), z];
};

// How far rotationTo(), applied to the first of two directions so many degrees apart, misses the second.
const DEGREE = Math.PI / 180;
function missed(degrees) {
    let worst = 0;
    for (let i = 0; i < 2000; ++i) {
        const from = vec3.clone(direction());
        const axis = vec3.cross(vec3.create(), direction(), from);
        vec3.normalize(axis, axis);
        const turn = quat.setAxisAngle(quat.create(), axis, degrees * DEGREE);
        const to = vec3.transformQuat(vec3.create(), from, turn);
        vec3.normalize(to, to);
        const found = quat.rotationTo(quat.create(), from, to);
        worst = Math.max(worst, vec3.distance(vec3.transformQuat(vec3.create(), from, found), to) / DEGREE);
    }
    return worst;
}

// The angle of orientations to themselves.
let nan = 0, greatest = 0;
const COUNT = 100000;
for (let i = 0; i < COUNT; ++i) {
    const one = quat.setAxisAngle(quat.create(), direction(), 2 * Math.PI * random());
    quat.normalize(one, one);
    const angle = quat.getAngle(one, one);
    nan += Number.isNaN(angle) ? 1 : 0;
    greatest = Number.isNaN(angle) ? greatest : Math.max(greatest, angle / DEGREE);
}

console.log("gl-matrix 3.4.4\ndegrees apart  missed by rotationTo()");
const near = [0.01, 0.05, 0.08], far = [0.09, 0.1, 1];
for (const degrees of [...near, ...far]) {
    console.log(`${String(degrees).padStart(13)}  ${missed(degrees).toFixed(6)}`);
}
console.log(`getAngle() of an orientation and itself: NaN in ${(100 * nan / COUNT).toFixed(1)} %, else up to ` +
            `${greatest.toFixed(3)} degrees`);
const asStated = near.every(degrees => Math.abs(missed(degrees) / degrees - 1) < 0.01) &&
    far.every(degrees => missed(degrees) < 1e-4) && nan > 0.3 * COUNT && nan < 0.7 * COUNT && greatest > 0.03;
console.log(asStated ? "as stated" : "NOT as stated: this finding is out of date");
process.exit(asStated ? 0 : 1);
CODE
node turns.js
