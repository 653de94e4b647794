// The page of recorded gaze: what each figure draws is in its data (gaze_page/gaze_figures.h).

const kEvents = ["fixation", "saccade", "oscillation", "pursuit", "lost"];

// Ticks at round numbers, as many as there is room for.
function roundTicks(axis, room) {
  const most = Math.max(2, room / 90);
  const decade = 10 ** Math.floor(Math.log10((axis.max - axis.min) / most || 1));
  const step = decade * ([1, 2, 5].find((times) => (axis.max - axis.min) / (decade * times) <= most) ?? 10);
  axis.ticks = [];
  for (let i = Math.ceil(axis.min / step); i * step <= axis.max; ++i) {
    axis.ticks.push({value: Number((i * step).toPrecision(12))});
  }
}

const numberAxis = (title, palette) => ({
  type: "linear", bounds: "data", grid: {color: palette.rule}, ticks: {color: palette.soft, autoSkip: false},
  title: {display: true, text: title, color: palette.soft}, afterBuildTicks: (axis) => roundTicks(axis, axis.width)});

// Points and lines of one quantity over another.
function pointsChart(figure, palette) {
  const sets = figure.sets.map(({name, points, form}, i) => ({
    label: name, showLine: form === "line", borderColor: palette.series[i], backgroundColor: faint(palette.series[i], 0.7),
    borderWidth: form === "line" ? 2 : 0, borderDash: i > 1 ? [6, 3] : [], pointRadius: form === "line" ? 0 : 3,
    pointHitRadius: form === "line" ? 0 : 4, data: points.map(([x, y]) => ({x, y}))}));
  const options = optionsOf({x: numberAxis(figure.x, palette), y: valueAxis(figure.y, palette,
    figure.centred ? {grace: "5%"} : {beginAtZero: true, grace: "5%"})}, palette, {
    callbacks: {title: () => "",
      label: ({dataset, raw}) => `${dataset.label}: ${rounded(raw.x)}, ${rounded(raw.y)}`}});
  options.interaction = {mode: "nearest", intersect: true};
  return {sets, legend: figure.sets.map(({name}, i) => [name, palette.series[i]]), options};
}

// How often a quantity lies where.
function barsChart(figure, palette) {
  const {first, width, counts, known, what} = figure;
  const edge = (bin) => first + bin * width;
  const shares = counts.map((count, bin) => ({x: edge(bin), y: 100 * count / known}));
  shares.push({x: edge(counts.length), y: 0});
  const say = (at) => (at < counts.length
    ? `${rounded(edge(at))} to ${rounded(edge(at + 1))}: ${counts[at]} of ${known} ${what}` : null);
  const sets = [line(what, shares, palette.series[0], {stepped: true, fill: "origin", pointRadius: 0,
    backgroundColor: faint(palette.series[0], 0.3), say})];
  const options = optionsOf({x: numberAxis(figure.x, palette), y: valueAxis(`% of ${what}`, palette, {beginAtZero: true})},
    palette, {filter: ({dataset, dataIndex}) => dataset.say(dataIndex) !== null,
      callbacks: {title: () => "", label: ({dataset, dataIndex}) => dataset.say(dataIndex)}});
  return {sets, legend: [], options};
}

function timeChart(figure, part, view, palette, context) {
  let sets = [];
  const legend = [];
  if (figure.events) {
    sets = bandSets(part, kEvents, (band, i) => 100 * part.bins.states[band][i] / part.bins.rows[i], palette,
      context, "%", {stepped: true, borderWidth: 0});
    kEvents.forEach((name, i) => legend.push([name, bandSwatch(palette, i)]));
  } else {
    figure.series.forEach(([key, name], i) => {
      sets = sets.concat(envelopeSets(part, key, name, palette.series[i], figure.unit));
      legend.push([name, palette.series[i]]);
    });
  }
  const x = timeAxis({time_known: true}, palette);
  x.min = view.from;
  x.max = view.to;
  const y = valueAxis(figure.unit, palette, figure.events ? {min: 0, max: 100} : {grace: "5%"});
  const options = optionsOf({x, y}, palette, {
    filter: ({dataset, dataIndex}) => Boolean(dataset.say) && dataset.say(dataIndex) !== null,
    callbacks: {title: (items) => (items.length > 0 ? timeText(items[0].parsed.x, true, 3) : ""),
      label: ({dataset, dataIndex}) => dataset.say(dataIndex)}});
  return {sets, legend, options};
}

async function start() {
  const data = JSON.parse(document.getElementById("plot-data").textContent);
  const plots = [];
  const streams = [];
  for (const stream of data.streams) {
    const head = {time_known: true, limits: [], end: stream.end,
      series: stream.series.map((key) => ({key, form: "envelope", unit: "deg"})), spans: []};
    streams.push({frames: new Frames(head, await readBins(head, stream), null), part: null});
  }
  const overTime = [];
  let asked = false;
  const first = document.querySelector("figure .plot");
  const choose = () => {
    const room = Math.min(1600, Math.max(400, first.clientWidth));
    for (const stream of streams) {
      stream.part = stream.frames.between(view.from, view.to, room);
    }
    if (streams.length > 0) {
      document.getElementById("shown").textContent =
        shownText({time_known: true}, view, streams[0].part, "sample");
    }
  };
  const view = new View(Math.max(0.01, ...streams.map(({frames}) => frames.end)), 0.01, () => {
    if (!asked) {
      asked = true;
      setTimeout(() => {  // not at the next picture: a page that is not seen has none
        asked = false;
        choose();
        const palette = colours();
        overTime.forEach((plot) => plot.show(palette));
      });
    }
  });
  choose();
  for (const figure of data.figures) {
    const element = document.getElementById(figure.id);
    if (figure.empty) {
      showEmpty(element);
      continue;
    }
    const draw = {points: (palette) => pointsChart(figure, palette), bars: (palette) => barsChart(figure, palette),
      time: (palette, context) => timeChart(figure, streams[figure.stream].part, view, palette, context)}[figure.kind];
    const plot = new Plot(element, draw);
    plots.push(plot);
    if (figure.kind === "time") {
      overTime.push(plot);
      listenTo(element.querySelector(".plot"), view, () => plot.chart.chartArea);
    }
  }
  moveByButtons(view);
  drawPlots(plots);
}

start();
