#!/usr/bin/env bash
# jsPsych 8.3.0 (npm): mean() of a column leaves out the trials without an answer; sd(), median() and min()
# of the same column take them for answers after 0 ms.
#
# A trial that ends by time has the rt null. Of 36 answers around 500 ms and four misses, the mean is
# that of the 36, as it should be since version 8. The standard deviation, printed beside it, is that of 40
# numbers of which four are 0: 170 ms instead of 54. The median is 11 ms too low, the minimum 0. A
# standard error by sd() and count() is three times too large, and a limit for outliers at the mean less 3
# sd is below 0. The documentation says of each method that it is of "the values in a DataColumn", with
# rt as its example, and nothing is raised.
# Say .subset((rt) => rt !== null) first: then all of them are of the answers.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"
npm install --silent --no-audit --no-fund --ignore-scripts --save-exact jspsych@8.3.0

cat >answers.js <<'CODE'
globalThis.window = globalThis;  // a browser's name for it
const { DataCollection } = require('jspsych');

let state = 1;
const random = () => (state = state * 48271 % 2147483647) / 2147483647;
const answers = Array.from({ length: 36 }, () =>
    Math.round(500 + 50 * Math.sqrt(-2 * Math.log(random())) * Math.cos(2 * Math.PI * random())));
const misses = [3, 12, 21, 30];  // before these answers
const trials = [];
answers.forEach((rt, i) => {
    if (misses.includes(i)) trials.push({ trial_type: 'html-keyboard-response', rt: null, response: null });
    trials.push({ trial_type: 'html-keyboard-response', rt, response: ' ' });
});

const mean = answers.reduce((sum, rt) => sum + rt, 0) / answers.length;
const sorted = [...answers].sort((a, b) => a - b);
const truly = {
    mean,
    sd: Math.sqrt(answers.reduce((sum, rt) => sum + (rt - mean) ** 2, 0) / (answers.length - 1)),
    median: (sorted[17] + sorted[18]) / 2,
    min: sorted[0],
};
const column = new DataCollection(trials).select('rt');
const answered = column.subset((rt) => rt !== null);
console.log(`${trials.length} trials, ${misses.length} of them without an answer`);
console.log('        of the answers  select(rt)  select(rt).subset(not null)');
const found = {};
for (const name of Object.keys(truly)) {
    found[name] = [truly[name], column[name](), answered[name]()];
    const [of, all, some] = found[name].map((value) => value.toFixed(1));
    console.log(`${name.padEnd(6)}  ${of.padStart(14)}  ${all.padStart(10)}  ${some.padStart(27)}`);
}
const same = (a, b) => Math.abs(a - b) < 1e-9;
const as_stated = Object.values(found).every(([of, , some]) => same(of, some)) &&
    same(found.mean[0], found.mean[1]) && found.sd[1] > 3 * found.sd[0] &&
    found.median[1] < found.median[0] - 2 && found.min[1] === 0;
console.log(as_stated ? 'as stated' : 'NOT as stated: this finding is out of date');
process.exit(as_stated ? 0 : 1);
CODE
node answers.js
