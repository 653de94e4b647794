// What every page with plots needs: their colours and axes, their legends, and how they are drawn
// anew when colours change or the page is printed. A page says in its own verdict whether all went
// well, because a browser tells nobody else.

const kPaper = {width: 690, scale: 3};

function verdict(state, text = "") {
  const element = document.getElementById("page-verdict");
  if (element.dataset.state === "failed") {
    return;
  }
  element.dataset.state = state;
  element.hidden = state !== "failed";
  element.className = state === "failed" ? "warning" : "";
  element.textContent = state === "failed"
    ? `The plots could not be drawn (${text}). The tables hold their numbers.` : "";
}
addEventListener("error", (event) => verdict("failed", event.message));
addEventListener("unhandledrejection", (event) => verdict("failed", String(event.reason?.message ?? event.reason)));

function showLegend(figure, legend) {
  figure.querySelector(".legend").replaceChildren(...legend.map(([name, fill]) => {
    const item = document.createElement("li");
    const swatch = document.createElement("span");
    swatch.className = "swatch";
    swatch.style.background = fill;
    item.append(swatch, name);
    return item;
  }));
}

function showEmpty(figure) {
  figure.classList.add("empty");
  figure.querySelector("canvas").remove();
  figure.querySelector(".nothing").hidden = false;
}

// A plot of the page: drawn anew whenever time or colours change.
class Plot {
  constructor(figure, draw) {
    this.figure = figure;
    this.draw = draw;
    this.canvas = figure.querySelector("canvas");
    this.chart = null;
  }

  show(palette) {
    const {sets, legend, options} = this.draw(palette, this.canvas.getContext("2d"));
    if (this.chart === null) {
      this.chart = new Chart(this.canvas, {type: "line", data: {datasets: sets}, options});
    } else {
      options.devicePixelRatio = this.chart.options.devicePixelRatio;
      this.chart.options = options;
      this.chart.data.datasets = sets;
      this.chart.update("none");
    }
    showLegend(this.figure, legend);
  }

  // On paper a plot is a picture: it is drawn at the paper's width, with its resolution.
  print(begin) {
    this.chart.options.devicePixelRatio = begin ? kPaper.scale : window.devicePixelRatio;
    if (begin) {
      this.height = this.chart.height;
      this.chart.resize(kPaper.width, this.height);
    } else {
      this.chart.resize();
    }
  }
}

function colours() {
  const style = getComputedStyle(document.documentElement);
  const named = (name) => style.getPropertyValue(name).trim();
  return {paper: named("--paper"), ink: named("--ink"), soft: named("--soft"), rule: named("--rule"),
    series: [1, 2, 3, 4, 5].map((i) => named(`--c${i}`))};
}

const faint = (colour, share) => colour + Math.round(255 * share).toString(16).padStart(2, "0");

function valueAxis(unit, palette, more = {}) {
  return {
    type: "linear", grid: {color: palette.rule}, ticks: {color: palette.soft, maxTicksLimit: 7},
    title: {display: true, text: unit, color: palette.soft}, afterFit: (axis) => { axis.width = 64; }, ...more};
}

function optionsOf(scales, palette, tooltip) {
  return {
    animation: false, responsive: true, maintainAspectRatio: false, parsing: false, normalized: true, spanGaps: false,
    events: ["mousemove", "mouseout"], interaction: {mode: "index", intersect: false, axis: "x"},
    color: palette.soft, font: {size: 12}, layout: {padding: {top: 6, right: 8}},
    elements: {line: {borderJoinStyle: "round"}}, scales,
    plugins: {legend: {display: false}, tooltip: {animation: false, displayColors: false, ...tooltip}},
  };
}

function showAllOf(plots) {
  const palette = colours();
  plots.forEach((plot) => plot.show(palette));
}

// Draws them, follows colours and paper, and says so in the page's verdict.
function drawPlots(plots) {
  const showAll = () => showAllOf(plots);
  showAll();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", showAll);
  addEventListener("beforeprint", () => {
    document.documentElement.dataset.paper = "";
    plots.forEach((plot) => plot.print(true));
    showAll();
  });
  addEventListener("afterprint", () => {
    delete document.documentElement.dataset.paper;
    plots.forEach((plot) => plot.print(false));
    showAll();
  });
  verdict("drawn", "");
  document.getElementById("page-verdict").dataset.plots = plots.length;
}
