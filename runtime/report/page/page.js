// Puts the page's parts together. It says in its own verdict whether all went well, because a
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
  for (const button of document.querySelectorAll("button[data-show]")) {
    button.addEventListener("click", () => {
      const at = Number(button.dataset.show);
      view.show(at - 0.25, at + 0.25);
      document.getElementById("age").scrollIntoView();
      document.querySelector("#age .plot").focus({preventScroll: true});
    });
  }
}

function shownText(data, view, part) {
  const decimals = view.to - view.from < 10 ? 3 : view.to - view.from < 600 ? 1 : 0;
  const times = `${timeText(view.from, data.time_known, decimals)} to ${timeText(view.to, data.time_known, decimals)}`;
  let rows = 0;
  for (let i = part.begin; i < part.end; ++i) {
    rows += part.bins.rows[i];
  }
  const each = rows / Math.max(1, part.end - part.begin);
  return each <= 1 ? `${times}: every frame`
    : `${times}: reduced, each point has the least and the greatest of ${each.toFixed(each < 10 ? 1 : 0)} frames`;
}

async function start() {
  const data = JSON.parse(document.getElementById("plot-data").textContent);
  const plots = [];
  const add = (id, known, draw) => {
    const figure = document.getElementById(id);
    if (known) {
      plots.push(new Plot(figure, draw));
    } else {
      showEmpty(figure);
    }
    return figure;
  };
  add("distribution", data.latch.known + data.display.known > 0, (palette) => distributionChart(data, palette));

  let view = null;
  let part = null;
  const timePlots = [];
  if (data.rows > 0) {
    const all = await readBins(data, data.all);
    const frames = new Frames(data, all, data.spans.length > 0 ? await readBins(data, data.single) : null);
    const room = () => Math.min(1600, Math.max(400, document.querySelector("#age .plot").clientWidth));
    const has = {
      age: all.least.gaze_age_at_display || all.least.gaze_age_at_latch || all.least.held_gaze_age_at_display,
      stages: Object.keys(all.mean).length > 0, above: true, states: true, events: data.events.length > 0,
      error: all.least.gaze_error_at_display || all.least.gaze_error_without_poses,
      pace: all.least.frame_interval || all.least.loop_time, clock: all.least.gaze_age_uncertainty};
    let asked = false;
    const changed = () => {
      if (!asked) {
        asked = true;
        setTimeout(() => {  // not at the next picture: a page that is not seen has none
          asked = false;
          showTime(colours());
        });
      }
    };
    view = new View(frames.end, data.time_known ? 2e-3 * (data.period_ms ?? 10) : 3, changed);
    const showTime = (palette) => {
      part = frames.between(view.from, view.to, room());
      document.getElementById("shown").textContent = shownText(data, view, part);
      for (const plot of timePlots) {
        plot.show(palette);
      }
    };
    for (const id of Object.keys(kPlotKinds)) {
      const figure = add(id, has[id], (palette, context) => {
        const options = timeOptions(id, data, palette);
        options.scales.x.min = view.from;
        options.scales.x.max = view.to;
        return kPlotKinds[id].events ? {sets: eventSets(data, view, palette), legend: [], options}
          : {...setsOf(id, data, part, view, palette, context), options};
      });
      if (has[id]) {
        const plot = plots[plots.length - 1];
        timePlots.push(plot);
        if (kPlotKinds[id].events) {
          figure.querySelector(".plot").style.height = `${60 + 26 * data.events.length}px`;
        }
        listenTo(figure.querySelector(".plot"), view,
          () => plot.chart.chartArea);
      }
    }
    part = frames.between(view.from, view.to, room());
    document.getElementById("shown").textContent = shownText(data, view, part);
    moveByButtons(view);
  } else {
    Object.keys(kPlotKinds).forEach((id) => add(id, false));
    document.querySelector(".toolbar").hidden = true;
  }

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

start();
