// What plots over time share: the buttons that move them, and the words for what is shown.

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
