// Puts the report's parts together.

function showByButtons(view) {
  for (const button of document.querySelectorAll("button[data-show]")) {
    button.addEventListener("click", () => {
      const at = Number(button.dataset.show);
      view.show(at - 0.25, at + 0.25);
      document.getElementById("age").scrollIntoView();
      document.querySelector("#age .plot").focus({preventScroll: true});
    });
  }
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
    showByButtons(view);
  } else {
    Object.keys(kPlotKinds).forEach((id) => add(id, false));
    document.querySelector(".toolbar").hidden = true;
  }

  drawPlots(plots);
}

start();
