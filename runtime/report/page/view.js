// Which time the plots show, and how a reader moves it: buttons, keys, wheel, pointer, two fingers.

class View {
  constructor(end, least, changed) {
    this.end = Math.max(end, least);
    this.least = least;
    this.changed = changed;
    this.from = 0;
    this.to = this.end;
  }

  show(from, to) {
    const span = Math.min(this.end, Math.max(this.least, to - from));
    const middle = (from + to) / 2;
    this.from = Math.min(Math.max(0, middle - span / 2), this.end - span);
    this.to = this.from + span;
    this.changed();
  }

  zoom(factor, at = (this.from + this.to) / 2) {
    const span = Math.min(this.end, Math.max(this.least, (this.to - this.from) * factor));
    const share = (at - this.from) / (this.to - this.from);
    this.show(at - share * span, at + (1 - share) * span);
  }

  shift(share) {
    const by = share * (this.to - this.from);
    this.show(this.from + by, this.to + by);
  }

  move(how) {
    switch (how) {
      case "in": return this.zoom(0.5);
      case "out": return this.zoom(2);
      case "left": return this.shift(-0.25);
      case "right": return this.shift(0.25);
      default: return this.show(0, this.end);
    }
  }
}

const kKeys = {"+": "in", "=": "in", "-": "out", "_": "out", ArrowLeft: "left", ArrowRight: "right",
  ArrowUp: "in", ArrowDown: "out", Home: "all"};

// `areaOf()`: the plot's left edge and width in the element, in px.
function listenTo(element, view, areaOf) {
  const timeAt = (clientX) => {
    const {left, width} = areaOf();
    const share = (clientX - element.getBoundingClientRect().left - left) / width;
    return view.from + Math.min(1, Math.max(0, share)) * (view.to - view.from);
  };
  element.addEventListener("keydown", (event) => {
    if (kKeys[event.key] && !event.ctrlKey && !event.metaKey && !event.altKey) {
      event.preventDefault();
      view.move(kKeys[event.key]);
    }
  });
  element.addEventListener("wheel", (event) => {
    if (event.ctrlKey || document.activeElement === element) {  // else the page scrolls
      event.preventDefault();
      view.zoom(Math.exp(Math.max(-1, Math.min(1, event.deltaY / 200))), timeAt(event.clientX));
    }
  }, {passive: false});
  element.addEventListener("dblclick", (event) => view.zoom(0.25, timeAt(event.clientX)));

  const fingers = new Map();
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return {apart: Math.max(8, Math.abs(a - b)), middle: (a + b) / 2};
  };
  let before = null;
  element.addEventListener("pointerdown", (event) => {
    if (event.button === 0 && fingers.size < 2) {
      fingers.set(event.pointerId, event.clientX);
      element.setPointerCapture(event.pointerId);
      before = fingers.size === 2 ? spread() : null;
    }
  });
  element.addEventListener("pointermove", (event) => {
    const last = fingers.get(event.pointerId);
    if (last === undefined) {
      return;
    }
    fingers.set(event.pointerId, event.clientX);
    if (fingers.size === 2) {
      const now = spread();
      view.zoom(before.apart / now.apart, timeAt(now.middle));
      before = now;
    } else if (event.clientX !== last) {
      view.shift((last - event.clientX) / areaOf().width);
    }
  });
  for (const end of ["pointerup", "pointercancel"]) {
    element.addEventListener(end, (event) => fingers.delete(event.pointerId));
  }
}
