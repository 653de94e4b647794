// The frames in bins, and wider bins of these: each level halves the one before, so that a plot of
// any length takes as many points as the screen has room for. A wider bin has the least and the
// greatest of its parts: no spike is lost.

const kStates = ["fresh", "held", "returning", "ahead", "not rendered"];

// What frame_plots.h says a set of bins holds.
async function readBins(data, part) {
  const reader = new NumberReader(await inflated(part.data));
  const n = part.bins;
  const bins = {n, time: reader.series(n, data.time_known ? 1e-5 : 1), frame: reader.series(n, 1),
    rows: reader.series(n, 1), states: kStates.map(() => reader.series(n, 1)),
    above: data.limits.map(() => reader.series(n, 1)), mean: {}, least: {}, greatest: {}};
  for (const {key, form, unit} of data.series) {
    const scale = unit === "deg" ? 0.001 : 0.01;
    if (form === "mean") {
      bins.mean[key] = reader.series(n, scale);
    } else {
      bins.least[key] = reader.series(n, scale);
      const heights = reader.series(n, scale);
      bins.greatest[key] = heights.map((height, i) => bins.least[key][i] + height);
    }
  }
  if (reader.at !== reader.bytes.length) {
    throw new Error("the page's frames are damaged");
  }
  return bins;
}

function halved(fine) {
  const n = Math.ceil(fine.n / 2);
  const each = (take) => Float64Array.from({length: n}, (_, i) => take(2 * i, 2 * i + 1));
  const sum = (from) => each((a, b) => from[a] + (b < fine.n ? from[b] : 0));
  const one = (from, choose) => each((a, b) => {
    if (b >= fine.n || Number.isNaN(from[b])) {
      return from[a];
    }
    return Number.isNaN(from[a]) ? from[b] : choose(from[a], from[b]);
  });
  const weighed = (from) => each((a, b) => {
    const known = [a, b].filter((i) => i < fine.n && !Number.isNaN(from[i]));
    const weight = known.reduce((all, i) => all + fine.states[0][i], 0);
    return known.length === 0 ? NaN
      : weight === 0 ? from[known[0]]
        : known.reduce((all, i) => all + from[i] * fine.states[0][i], 0) / weight;
  });
  const all = (of, take) => Object.fromEntries(Object.entries(of).map(([key, from]) => [key, take(from)]));
  return {n, time: each((a) => fine.time[a]), frame: each((a) => fine.frame[a]), rows: sum(fine.rows),
    states: fine.states.map(sum), above: fine.above.map(sum), mean: all(fine.mean, weighed),
    least: all(fine.least, (from) => one(from, Math.min)),
    greatest: all(fine.greatest, (from) => one(from, Math.max))};
}

function levelsOf(bins) {
  const levels = [bins];
  while (levels[levels.length - 1].n > 512) {
    levels.push(halved(levels[levels.length - 1]));
  }
  return levels;
}

// The first bin that begins at the time or later.
function firstFrom(times, time) {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] < time) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

// What there is of the frames from one time to another, in at most `room` bins or so. It reaches
// one bin further on both sides, so that lines run to the edges.
class Frames {
  constructor(data, all, single) {
    this.levels = levelsOf(all);
    this.single = single;
    this.end = data.time_known ? data.end * 1e-5 : data.end;
    this.spans = [];
    let first = 0;
    for (const [from, to] of data.spans) {
      const last = first + to - from - 1;
      this.spans.push({first, last, from: single.time[first], to: single.time[last]});
      first = last + 1;
    }
  }

  between(from, to, room) {
    const span = this.spans.find((one) => one.from <= from && to <= one.to);
    if (span) {
      const begin = Math.max(span.first, firstFrom(this.single.time, from) - 1);
      const end = Math.min(span.last + 1, firstFrom(this.single.time, to) + 2);
      if (end - begin <= room) {
        return {bins: this.single, begin, end};
      }
    }
    for (const bins of this.levels) {
      const begin = Math.max(0, firstFrom(bins.time, from) - 1);
      const end = Math.min(bins.n, firstFrom(bins.time, to) + 2);
      if (end - begin <= room || bins === this.levels[this.levels.length - 1]) {
        return {bins, begin, end};
      }
    }
  }
}
