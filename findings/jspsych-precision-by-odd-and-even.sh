#!/usr/bin/env bash
# jsPsych's plugin-webgazer-validate 2.1.0 (npm): the precision of an eye tracker that it reports is half as
# large again where the number of samples is even.
#
# For each target the plugin stores average_offset, whose r is by its documentation "the median distance r
# of the points from this average offset". Of an odd number of samples it is. Of an even number the two
# amid have to be averaged; the plugin adds the first of them to half of the second, so that r is 1.5 times
# the median: 59 samples that all lie 10 pixels off their middle have an r of 10, 60 have 15, 61 have 10.
# How many there are within the two seconds of a target is chance. So the targets of one participant, or
# one target before and after, differ by half for nothing, and a limit on r for calibrating again asks
# more of the even ones. x, y and percent_in_roi are right, and nothing is said.
# Take r from raw_gaze, which is stored beside it.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"
npm install --silent --no-audit --no-fund --ignore-scripts --save-exact \
    @jspsych/plugin-webgazer-validate@2.1.0 @jspsych/extension-webgazer@1.2.0 jspsych@8.3.0

cat >precision.js <<'CODE'
// What the plugin touches of a browser: a page whose target lies at 0, 0, and its frames.
globalThis.window = globalThis;
globalThis.requestAnimationFrame = (run) => setTimeout(run, 1);
const page = {
    innerHTML: '',
    querySelector: () => page,
    getBoundingClientRect: () => ({ left: 0, top: 0, width: 0, height: 0 }),
};
const Validate = require('@jspsych/plugin-webgazer-validate');

// A validation of one target, in which the tracker gives these points, as the plugin stores it.
function validate(points) {
    return new Promise((resolve) => {
        const webgazer = {
            onGazeUpdate(tell) {
                setTimeout(() => points.forEach(([x, y], i) => tell({ x, y, t: 33 * i })), 5);
                return () => {};
            },
            startSampleInterval() {},
            stopSampleInterval() {},
        };
        const trial = { validation_points: [[50, 50]], validation_point_coordinates: 'percent', roi_radius: 200,
                        time_to_saccade: 0, validation_duration: 50, point_size: 20 };
        new Validate({ extensions: { webgazer }, finishTrial: resolve }).trial(page, trial);
    });
}

// The same from the raw samples: the median distance to the mean point.
function median_distance(samples) {
    const mean = (axis) => samples.reduce((sum, sample) => sum + sample[axis], 0) / samples.length;
    const [x, y] = [mean('dx'), mean('dy')];
    const sorted = samples.map(({ dx, dy }) => Math.hypot(dx - x, dy - y)).sort((a, b) => a - b);
    const half = sorted.length / 2;
    return (sorted[Math.ceil(half) - 1] + sorted[Math.floor(half)]) / 2;
}

let state = 1;
const random = () => (state = state * 48271 % 2147483647) / 2147483647;
const ring = (count) => Array.from({ length: count }, (_, i) => {
    const turn = 2 * Math.PI * i / count;
    return [10 * Math.cos(turn), 10 * Math.sin(turn)];
});
const noise = (count) => Array.from({ length: count }, () => {
    const length = 40 * Math.sqrt(-2 * Math.log(random())), turn = 2 * Math.PI * random();
    return [30 + length * Math.cos(turn), length * Math.sin(turn)];
});

(async () => {
    console.log('samples                      r stored  median distance');
    let as_stated = true;
    for (const [name, points] of [['all 10 pixels off', ring], ['scattered by 40 pixels', noise]]) {
        for (const count of [58, 59, 60, 61]) {
            const { average_offset, raw_gaze } = await validate(points(count));
            const { r } = average_offset[0], truly = median_distance(raw_gaze[0]);
            console.log(`${String(count).padStart(2)} ${name.padEnd(24)}  ${r.toFixed(2).padStart(8)}` +
                        `  ${truly.toFixed(2).padStart(15)}`);
            as_stated &&= raw_gaze[0].length === count &&
                Math.abs(r / truly - (count % 2 === 0 ? 1.5 : 1)) < 0.03;
        }
    }
    console.log(as_stated ? 'as stated' : 'NOT as stated: this finding is out of date');
    process.exit(as_stated ? 0 : 1);
})();
CODE
node precision.js
