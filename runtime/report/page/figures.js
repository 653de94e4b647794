// What a page's figures share. The page says in its own verdict whether all went well, because a
// browser tells nobody else.

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

function moveByButtons(view) {
  for (const button of document.querySelectorAll("button[data-move]")) {
    button.addEventListener("click", () => view.move(button.dataset.move));
  }
}

// `what` a bin's rows are.
function shownText(data, view, part, what = "frame") {
  const decimals = view.to - view.from < 10 ? 3 : view.to - view.from < 600 ? 1 : 0;
  const times = `${timeText(view.from, data.time_known, decimals)} to ${timeText(view.to, data.time_known, decimals)}`;
  let rows = 0;
  for (let i = part.begin; i < part.end; ++i) {
    rows += part.bins.rows[i];
  }
  const each = rows / Math.max(1, part.end - part.begin);
  return each <= 1 ? `${times}: every ${what}`
    : `${times}: reduced, each point has the least and the greatest of ${each.toFixed(each < 10 ? 1 : 0)} ${what}s`;
}

// Draws them, and again whenever colours change or paper is asked for.
function keepDrawn(plots) {
  const showAll = () => {
    const palette = colours();
    plots.forEach((plot) => plot.show(palette));
  };
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
