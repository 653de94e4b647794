#!/usr/bin/env bash
# PlayCanvas 2.23.3 (npm; an engine of WebXR pages): between two rotations less than .1146 degrees apart,
# slerp() gives their middle, whatever part of the way was asked for.
#
# Quat.slerp(a, b, alpha) halves the way where the sine of half the angle is under .001: alpha 0 is not a
# and 1 is not b, though its documentation shows both, and nothing is said. From .115 degrees on it is exact.
# Two samples of a head or an eye are that near at each turn slower than 10 degrees per second at 90 Hz,
# 115 at 1000 Hz. A turn recorded at 90 Hz and played at 720 Hz then stands still for 7 frames and jumps at
# the 8th. A prediction half a frame ahead, alpha 1.5, comes out half a frame back. A filter that goes a
# tenth of the way each frame comes through the last tenth of a degree in 7 frames instead of 44.
# lerp() normalises and is right to 1e-6 of such a turn: take it below a degree, and slerp() above.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"
echo '{"type": "module"}' >package.json
npm install --silent --no-audit --no-fund --ignore-scripts --save-exact playcanvas@2.23.3

cat >turns.js <<'CODE'
import { Quat, Vec3, version } from 'playcanvas';

const DEGREE = Math.PI / 180;
const turn = (degrees) => new Quat().setFromAxisAngle(Vec3.UP, degrees);
const angle = (q) => 2 * Math.atan2(q.y, q.w) / DEGREE;

// Which part of the way from no turn to one of so many degrees an interpolation comes to.
const part = (how, degrees, alpha) => angle(new Quat()[how](new Quat(), turn(degrees), alpha)) / degrees;
const alphas = [0, 0.1, 0.5, 0.9, 1, 1.5];
const near = [0.01, 0.1, 0.1145], far = [0.115, 0.2, 1];
const row = (cells) => cells.map((cell) => String(cell).padStart(8)).join('');
console.log(`PlayCanvas ${version}\nparts of the way by slerp(), where these are asked for`);
console.log(row(['degrees', ...alphas]));
for (const degrees of [...near, ...far]) {
    console.log(row([degrees, ...alphas.map((alpha) => part('slerp', degrees, alpha).toFixed(3))]));
}

// A turn of 9 degrees per second, sampled at 90 Hz, played at 720 Hz: the steps of its frames.
const steps = [];
for (let frame = 1; frame <= 24; frame++) {
    const place = (n) => {
        const sample = Math.floor(n / 8);
        return angle(new Quat().slerp(turn(0.1 * sample), turn(0.1 * sample + 0.1), n / 8 - sample));
    };
    steps.push(place(frame) - place(frame - 1));
}
console.log(`steps of 24 frames that are 0.0125 degrees each: ${steps.map((s) => s.toFixed(4)).join(' ')}`);

// A filter that goes a tenth of the way each frame: frames until a hundredth of the turn is left.
const settle = (how, degrees) => {
    const q = new Quat(), goal = turn(degrees);
    let frames = 0;
    for (; Math.abs(1 - angle(q) / degrees) > 0.01; frames++) q[how](q.clone(), goal, 0.1);
    return frames;
};
const slow = settle('lerp', 0.1), fast = settle('slerp', 0.1);
console.log(`a tenth of the way each frame, to 1 % of 0.1 degrees: ${slow} frames by lerp(), ${fast} by slerp()`);

const is = (a, b, within) => Math.abs(a - b) <= within;
const as_stated =
    near.every((degrees) => alphas.every((alpha) => is(part('slerp', degrees, alpha), 0.5, 1e-6))) &&
    far.every((degrees) => alphas.every((alpha) => is(part('slerp', degrees, alpha), alpha, 1e-6))) &&
    near.every((degrees) => alphas.every((alpha) => is(part('lerp', degrees, alpha), alpha, 1e-6))) &&
    steps.every((step, i) => is(step, i % 8 === 7 ? 0.1 : 0, 1e-6)) && slow === 44 && fast === 7;
console.log(as_stated ? 'as stated' : 'NOT as stated: this finding is out of date');
process.exit(as_stated ? 0 : 1);
CODE
node turns.js
