// What each plot is made of. Colours come from the style sheet, so that they follow the scheme.

const kPlotKinds = {
  age: {unit: "ms", envelopes: ["gaze_age_at_display", "gaze_age_at_latch", "held_gaze_age_at_display"],
    names: ["when shown", "when used", "held gaze, when shown"], limit: "gaze_age_at_display"},
  stages: {unit: "ms", stack: true},
  above: {unit: "%", shares: true},
  error: {unit: "deg", envelopes: ["gaze_error_at_display", "gaze_error_without_poses"],
    names: ["gaze held in the world", "gaze held in the head"]},
  states: {unit: "%", states: true},
  pace: {unit: "ms", envelopes: ["frame_interval", "loop_time"], names: ["frame interval", "loop (CPU)"],
    period: true},
  clock: {unit: "ms", envelopes: ["gaze_age_uncertainty"], names: ["uncertain by"]},
  events: {events: true},
};

// Five colours, and five hatched ones: colour alone need not tell them apart.
function bandFill(palette, i, context) {
  const colour = palette.series[i % 5];
  if (i < 5) {
    return faint(colour, 0.8);
  }
  const tile = document.createElement("canvas");
  tile.width = tile.height = 8;
  const pen = tile.getContext("2d");
  pen.fillStyle = faint(colour, 0.3);
  pen.fillRect(0, 0, 8, 8);
  pen.strokeStyle = colour;
  pen.lineWidth = 2;
  pen.beginPath();
  for (const x of [-8, 0, 8]) {
    pen.moveTo(x, 8);
    pen.lineTo(x + 8, 0);
  }
  pen.stroke();
  return context.createPattern(tile, "repeat");
}

function bandSwatch(palette, i) {
  const colour = palette.series[i % 5];
  return i < 5 ? faint(colour, 0.8)
    : `repeating-linear-gradient(135deg, ${colour} 0 2px, ${faint(colour, 0.3)} 2px 5px)`;
}

const rounded = (number, digits = 2) => number.toFixed(digits).replace("-0.00", "0.00");

// A point that stands alone between unknown ones has no line: it is drawn as a dot.
function radii(points) {
  return points.map(({y}, i) => (y !== null && (points[i - 1]?.y ?? null) === null &&
    (points[i + 1]?.y ?? null) === null ? 2 : 0));
}

function line(label, points, colour, more = {}) {
  return {label, data: points, borderColor: colour, backgroundColor: colour, borderWidth: 1.5, fill: false,
    pointRadius: radii(points), pointHitRadius: 0, pointBackgroundColor: colour, tension: 0, ...more};
}

function pointsOf(part, numberAt) {
  const points = [];
  for (let i = part.begin; i < part.end; ++i) {
    const y = numberAt(i);
    points.push({x: part.bins.time[i], y: Number.isFinite(y) ? y : null});
  }
  return points;
}

function envelopeSets(part, key, name, colour, unit) {
  const {least, greatest} = part.bins;
  if (!least[key]) {
    return [];
  }
  const say = (i) => {
    const [low, high] = [least[key][part.begin + i], greatest[key][part.begin + i]];
    return Number.isNaN(low) ? null
      : low === high ? `${name}: ${rounded(low)} ${unit}`
        : `${name}: ${rounded(low)} to ${rounded(high)} ${unit}`;
  };
  return [
    line(name, pointsOf(part, (i) => greatest[key][i]), colour, {fill: "+1",
      backgroundColor: faint(colour, 0.25), say}),
    line(name, pointsOf(part, (i) => least[key][i]), colour, {borderWidth: 1}),
  ];
}

// Bands one upon the other: each line is the sum of all up to it.
function bandSets(part, names, numberAt, palette, context, unit, more) {
  const sums = new Float64Array(part.end - part.begin).fill(NaN);
  return names.map((name, band) => {
    const own = (i) => numberAt(band, i);
    const points = pointsOf(part, (i) => {
      const at = i - part.begin;
      if (!Number.isNaN(own(i))) {
        sums[at] = (Number.isNaN(sums[at]) ? 0 : sums[at]) + own(i);
      }
      return sums[at];
    });
    return line(name, points, palette.paper, {
      borderWidth: 0.75, fill: band === 0 ? "origin" : "-1", backgroundColor: bandFill(palette, band, context),
      say: (i) => {
        const number = own(part.begin + i);
        return Number.isNaN(number) || (unit === "%" && number === 0) ? null : `${name}: ${rounded(number)} ${unit}`;
      }, ...more});
  });
}

const level = (view, y, name, palette) => line(name, [{x: view.from, y}, {x: view.to, y}], palette.soft,
  {borderDash: [5, 4], pointRadius: 0, borderWidth: 1.25});

// Datasets of one plot over time, and its legend.
function setsOf(id, data, part, view, palette, context) {
  const kind = kPlotKinds[id];
  const legend = [];
  let sets = [];
  if (kind.envelopes) {
    kind.envelopes.forEach((key, i) => {
      const found = envelopeSets(part, key, kind.names[i], palette.series[i], kind.unit);
      if (found.length > 0) {
        legend.push([kind.names[i], palette.series[i]]);
      }
      sets = sets.concat(found);
    });
    const limit = data.limits.find(({key, ms}) => key === kind.limit && ms !== null);
    if (limit && sets.length > 0) {
      sets.push(level(view, limit.ms, "limit", palette));
      legend.push([`limit, ${limit.ms} ms`, palette.soft]);
    }
    if (kind.period && data.period_ms !== null && sets.length > 0) {
      sets.push(level(view, data.period_ms, "display period", palette));
      legend.push([`display period, ${rounded(data.period_ms)} ms`, palette.soft]);
    }
  } else if (kind.stack) {
    const stages = data.series.filter(({form}) => form === "mean");
    sets = bandSets(part, stages.map(({label}) => label), (band, i) => part.bins.mean[stages[band].key][i],
      palette, context, kind.unit, {});
    stages.forEach(({label}, i) => legend.push([label, bandSwatch(palette, i)]));
  } else if (kind.states) {
    sets = bandSets(part, kStates, (band, i) => 100 * part.bins.states[band][i] / part.bins.rows[i], palette,
      context, kind.unit, {stepped: true, borderWidth: 0});
    kStates.forEach((name, i) => legend.push([name === "fresh" ? "fresh gaze" : name, bandSwatch(palette, i)]));
  } else if (kind.shares) {
    sets = data.limits.map(({key, label, ms}, i) => {
      const name = key === "periods_missed" ? "shown later than announced" : `${label} above ${ms} ms`;
      legend.push([name, palette.series[i % 5]]);
      const share = (at) => 100 * part.bins.above[i][at] / part.bins.rows[at];
      return line(name, pointsOf(part, share), palette.series[i % 5], {stepped: true,
        borderDash: i < 5 ? [] : [3, 2], say: (at) => `${name}: ${rounded(share(part.begin + at))} %`});
    });
  }
  return {sets, legend};
}

function eventSets(data, view, palette) {
  return data.events.map(({kind, marks}, lane) => ({
    label: kind, type: "scatter", showLine: false, borderColor: palette.series[lane % 5],
    backgroundColor: faint(palette.series[lane % 5], 0.75), pointHitRadius: 4,
    data: marks.filter(([at]) => at >= view.from && at <= view.to).map(([x, times]) => ({x, y: lane, times})),
    pointRadius: (at) => 3 + Math.min(4, Math.log2(at.raw?.times ?? 1)),
  }));
}

// ---- axes ----------------------------------------------------------------------------------------

const kSteps = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900,
  1800, 3600, 7200, 14400, 43200, 86400];

function stepFor(span, most) {
  const least = span / most;
  return kSteps.find((step) => step >= least) ?? 86400 * 10 ** Math.ceil(Math.log10(least / 86400));
}

function timeText(seconds, known, decimals) {
  if (!known) {
    return `frame ${Math.round(seconds)}`;
  }
  if (Math.abs(seconds) < 60) {
    return `${seconds.toFixed(decimals)} s`;
  }
  const [whole, part] = Math.abs(seconds).toFixed(decimals).split(".");
  const two = (number) => String(number).padStart(2, "0");
  const minutes = Math.floor(whole / 60);
  return `${seconds < 0 ? "-" : ""}${minutes < 60 ? minutes : `${Math.floor(minutes / 60)}:${two(minutes % 60)}`}:` +
    two(whole % 60) + (part ? `.${part}` : "");
}

function timeAxis(data, palette) {
  return {
    type: "linear", bounds: "data", grid: {color: palette.rule, drawTicks: true, tickLength: 5},
    border: {color: palette.rule},
    afterBuildTicks: (axis) => {
      const step = data.time_known ? stepFor(axis.max - axis.min, Math.max(2, axis.width / 110))
        : Math.max(1, Math.ceil((axis.max - axis.min) / Math.max(2, axis.width / 110)));
      axis.step = step;
      axis.ticks = [];
      for (let i = Math.ceil(axis.min / step); i * step <= axis.max; ++i) {
        axis.ticks.push({value: i * step});
      }
    },
    ticks: {color: palette.soft, autoSkip: false, maxRotation: 0,
      callback(value) {
        const decimals = this.step >= 1 ? 0 : Math.ceil(-Math.log10(this.step) - 1e-9);
        return timeText(value, data.time_known, decimals);
      }},
  };
}

function timeOptions(id, data, palette) {
  const kind = kPlotKinds[id];
  const x = timeAxis(data, palette);
  const title = (items) => (items.length > 0 ? timeText(items[0].parsed.x, data.time_known, 3) : "");
  if (kind.events) {
    const y = valueAxis("", palette, {min: -0.6, max: data.events.length - 0.4, reverse: true,
      title: {display: false}, afterFit: (axis) => { axis.width = 150; },
      afterBuildTicks: (axis) => { axis.ticks = data.events.map((_, value) => ({value})); },
      ticks: {color: palette.ink, autoSkip: false, callback: (value) => data.events[value]?.kind ?? ""}});
    const options = optionsOf({x, y}, palette, {callbacks: {title,
      label: ({dataset, raw}) => `${dataset.label}${raw.times > 1 ? `, ${raw.times} times` : ""}`}});
    options.interaction = {mode: "nearest", intersect: true};
    return options;
  }
  const y = valueAxis(kind.unit, palette, kind.states ? {min: 0, max: 100}
    : kind.shares ? {min: 0, suggestedMax: 1} : {beginAtZero: true, grace: "5%"});
  return optionsOf({x, y}, palette, {
    filter: ({dataset, dataIndex}) => Boolean(dataset.say) && dataset.say(dataIndex) !== null,
    callbacks: {title, label: ({dataset, dataIndex}) => dataset.say(dataIndex)}});
}

// ---- the distribution ----------------------------------------------------------------------------

function distributionChart(data, palette) {
  const both = [["when used", data.latch], ["when shown", data.display]].filter(([, one]) => one.known > 0);
  const sets = [];
  const legend = [];
  both.forEach(([name, one], i) => {
    const colour = palette.series[i === 0 && both.length > 1 ? 1 : 0];
    const edge = (bin) => one.first_ms + bin * one.width_ms;
    const shares = one.frames.map((frames, bin) => ({x: edge(bin), y: 100 * frames / one.known}));
    shares.push({x: edge(one.frames.length), y: 0});
    let sum = 0;
    const sums = [{x: edge(0), y: 0}];
    one.frames.forEach((frames, bin) => {
      sum += frames;
      sums.push({x: edge(bin + 1), y: 100 * sum / one.known});
    });
    sets.push(line(`${name}, share`, shares, colour, {stepped: true, fill: "origin", pointRadius: 0,
      backgroundColor: faint(colour, 0.3),
      say: (at) => (at < one.frames.length ? `${name}, ${rounded(edge(at))} to ${rounded(edge(at + 1))} ms: ` +
        `${rounded(shares[at].y)} % of frames` : null)}));
    sets.push(line(`${name}, up to here`, sums, colour, {yAxisID: "sum", pointRadius: 0, borderDash: [6, 3],
      say: (at) => `${name}, up to ${rounded(sums[at].x)} ms: ${rounded(sums[at].y)} %`}));
    legend.push([name, colour]);
  });
  const scales = {
    x: {type: "linear", bounds: "data", grid: {color: palette.rule}, ticks: {color: palette.soft, autoSkip: false},
      title: {display: true, text: "age, ms", color: palette.soft},
      afterBuildTicks: (axis) => {
        const most = Math.max(2, axis.width / 90);
        const decade = 10 ** Math.floor(Math.log10((axis.max - axis.min) / most || 1));
        const step = decade * ([1, 2, 5].find((times) => (axis.max - axis.min) / (decade * times) <= most) ?? 10);
        axis.ticks = [];
        for (let i = Math.ceil(axis.min / step); i * step <= axis.max; ++i) {
          axis.ticks.push({value: i * step});
        }
      }},
    y: valueAxis("% of frames in the bin", palette, {beginAtZero: true}),
    sum: valueAxis("% of frames up to there", palette, {position: "right", min: 0, max: 100, grid: {drawOnChartArea: false}}),
  };
  const options = optionsOf(scales, palette, {
    filter: ({dataset, dataIndex}) => dataset.say(dataIndex) !== null,
    callbacks: {title: () => "", label: ({dataset, dataIndex}) => dataset.say(dataIndex)}});
  return {sets, legend, options};
}
