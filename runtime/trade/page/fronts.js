// The fronts: cost against quality, every point, and for each method a line through the points
// that no other of its own beats in both. What stands on hover is on the page too.

const kMarks = ["circle", "rect", "triangle", "rectRot", "crossRot", "star", "rectRounded", "cross"];
const kCosts = {
  cells: {label: "fewer cells than full resolution, times", of: (point) => point.fewer},
  time: {label: "faster than full resolution, times", of: (point) => point.faster},
};

const shortNumber = (value) => (Math.abs(value) >= 100 ? value.toFixed(0) : Number(value.toPrecision(3)).toString());

// Of a method's points, those that none of them beats in both: best quality first.
function ownFront(points) {
  const sorted = [...points].sort((a, b) => a.loss - b.loss || b.x - a.x);
  const front = [];
  for (const point of sorted) {
    if (front.length === 0 || point.x > front[front.length - 1].x) {
      front.push(point);
    }
  }
  return front;
}

function frontSets(data, sheet, cost, key, palette) {
  const figure = data.figures.find((one) => one.key === key);
  const methods = [...new Set(data.sheets[sheet].points.map(({method}) => method))];
  const sets = [];
  const legend = [];
  methods.forEach((method, i) => {
    const colour = palette.series[i % palette.series.length];
    const mark = kMarks[i % kMarks.length];
    const points = data.sheets[sheet].points.filter((point) => point.method === method)
      .map((point) => ({point, x: kCosts[cost].of(point), y: point.figures[key]}))
      .filter(({x, y}) => Number.isFinite(x) && Number.isFinite(y))
      .map((one) => ({...one, loss: figure.lower_is_better ? one.y : -one.y}));
    if (points.length === 0) {
      return;
    }
    const front = ownFront(points);
    sets.push({label: method, type: "line", data: front, borderColor: colour, backgroundColor: colour, borderWidth: 1.5,
      pointRadius: 0, pointHitRadius: 0, fill: false, tension: 0, order: 2, borderDash: i < 5 ? [] : [5, 3]});
    sets.push({label: method, type: "scatter", showLine: false, data: points, borderColor: colour,
      backgroundColor: points.map(({point}) => (point.on_front[cost] ? colour : palette.paper)),
      pointStyle: mark, pointRadius: 5.5, pointHoverRadius: 8, pointBorderWidth: 1.5, order: 1, says: true});
    legend.push([method, colour]);
  });
  return {sets, legend, figure};
}

// A little beyond the points: by itself the axis would end at powers of ten.
function costAxis(cost, sets, palette) {
  const costs = sets.flatMap(({data}) => data.map(({x}) => x));
  return {type: "logarithmic", grid: {color: palette.rule}, border: {color: palette.rule},
    min: 0.93 * Math.min(...costs), max: 1.07 * Math.max(...costs),
    title: {display: true, text: kCosts[cost].label, color: palette.soft},
    afterBuildTicks: (axis) => {
      const values = [];
      for (let decade = 10 ** Math.floor(Math.log10(axis.min)); decade <= axis.max; decade *= 10) {
        values.push(...[1, 1.5, 2, 3, 5, 7].map((step) => step * decade));
      }
      axis.ticks = values.filter((value) => value >= axis.min && value <= axis.max).map((value) => ({value}));
    },
    ticks: {color: palette.soft, autoSkip: true, maxRotation: 0, callback: (value) => shortNumber(value)}};
}

function frontChart(data, sheet, cost, key, palette) {
  const {sets, legend, figure} = frontSets(data, sheet, cost, key, palette);
  const y = valueAxis(`${key}, ${figure.lower_is_better ? "lower" : "higher"} is better`, palette,
    figure.lower_is_better ? {reverse: true, beginAtZero: true} : {grace: "6%"});
  const options = optionsOf({x: costAxis(cost, sets, palette), y}, palette, {
    filter: ({dataset}) => Boolean(dataset.says),
    callbacks: {title: () => "", label: ({raw}) => [raw.point.name,
      `${shortNumber(raw.point.fewer)} times fewer cells, ${shortNumber(raw.point.faster)} times faster, ${shortNumber(raw.point.ms)} ms`,
      `${key} ${shortNumber(raw.y)}`]}});
  options.interaction = {mode: "nearest", intersect: true};
  options.onHover = (event, found) => {
    const at = found.find(({datasetIndex}) => sets[datasetIndex].says);
    hover(sheet, event.native, at ? sets[at.datasetIndex].data[at.index].point : null);
  };
  return {sets, legend, options};
}

// The point's pictures beside the pointer, where it has some.
function hover(sheet, event, point) {
  const card = document.getElementById("hovered");
  document.querySelectorAll(".point.shown").forEach((one) => one.classList.remove("shown"));
  const of = point === null ? null
    : document.querySelector(`#case-${sheet} .point[data-point="${point.index}"]`);
  card.hidden = of === null;
  if (of === null) {
    return;
  }
  of.classList.add("shown");
  card.replaceChildren(...[...of.children].map((child) => child.cloneNode(true)));
  const left = event.clientX + 24 + card.offsetWidth < innerWidth ? event.clientX + 24 : event.clientX - 24 - card.offsetWidth;
  card.style.left = `${Math.max(4, left)}px`;
  card.style.top = `${Math.max(4, Math.min(event.clientY + 24, innerHeight - card.offsetHeight - 4))}px`;
}

function start() {
  const data = JSON.parse(document.getElementById("plot-data").textContent);
  const select = document.getElementById("figure");
  const card = document.createElement("figure");
  card.id = "hovered";
  card.className = "point hovered";
  card.hidden = true;
  document.body.append(card);
  const plots = [];
  for (const figure of document.querySelectorAll("figure[data-sheet]")) {
    const sheet = Number(figure.dataset.sheet);
    if (data.sheets[sheet].points.length > 0) {
      plots.push(new Plot(figure, (palette) => frontChart(data, sheet, figure.dataset.cost, select.value, palette)));
      figure.querySelector("canvas").addEventListener("mouseleave", () => hover(sheet, null, null));
    } else {
      showEmpty(figure);
    }
  }
  select.addEventListener("change", () => showAllOf(plots));
  const showMeaning = () => {
    document.getElementById("figure-meaning").textContent =
      data.figures.find(({key}) => key === select.value)?.meaning ?? "";
  };
  select.addEventListener("change", showMeaning);
  showMeaning();
  drawPlots(plots);
}

start();
