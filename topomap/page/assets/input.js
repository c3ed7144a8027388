// What keys, mouse, fingers and buttons do.

const KEYS = {
  " ": () => setPlaying(!isPlaying),
  ",": () => step(-1),
  ".": () => step(1),
  Home: () => goTo(0),
  End: () => goTo(run.end),
  ArrowLeft: () => move(() => view.pan(60, 0)),
  ArrowRight: () => move(() => view.pan(-60, 0)),
  ArrowUp: () => move(() => view.pan(0, 60)),
  ArrowDown: () => move(() => view.pan(0, -60)),
  "+": () => move(() => view.zoom(1.3)),
  "=": () => move(() => view.zoom(1.3)),
  "-": () => move(() => view.zoom(1 / 1.3)),
  f: fit,
  n: () => nextVertex(1),
  p: () => nextVertex(-1),
  d: switchTheme,
  "?": () => element("keys").showModal(),
  Escape: () => choose(null),
};

function listenToKeys() {
  document.addEventListener("keydown", (event) => {
    const isTaken = event.target.matches("input[type=range], select, dialog *") || (event.key === " " && event.target.matches("button, input"));
    const action = KEYS[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action || isTaken || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
  });
}

function listenToPointers() {
  const down = new Map();
  let travelled = 0;
  const local = (event) => {
    const { left, top } = scene.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
  const spread = ([a, b]) => Math.hypot(a[0] - b[0], a[1] - b[1]);
  scene.addEventListener("pointerdown", (event) => {
    scene.setPointerCapture(event.pointerId);
    if (!down.size) travelled = 0;
    down.set(event.pointerId, local(event));
  });
  scene.addEventListener("pointermove", (event) => {
    const [px, py] = local(event);
    if (!down.has(event.pointerId)) {
      pointer = event.pointerType === "mouse" ? [px, py] : null;
      showTip(pointer && find(view, moment, shown, px, py), pointer, view);
      return;
    }
    pointer = null;
    const before = [...down.values()];
    const [ox, oy] = down.get(event.pointerId);
    down.set(event.pointerId, [px, py]);
    const after = [...down.values()];
    travelled += Math.hypot(px - ox, py - oy);
    if (travelled < 4) return;
    move(() => {
      view.pan((px - ox) / after.length, (py - oy) / after.length);
      if (after.length === 2) {
        const [[ax, ay], [bx, by]] = after;
        view.zoom(spread(after) / Math.max(spread(before), 1), (ax + bx) / 2, (ay + by) / 2);
      }
    });
  });
  const up = (event) => {
    down.delete(event.pointerId);
    if (event.type !== "pointerup" || travelled >= 4) return;
    const near = event.pointerType === "mouse" ? NEAR : 2 * NEAR;
    choose(find(view, moment, shown, ...local(event), near));
  };
  scene.addEventListener("pointerup", up);
  scene.addEventListener("pointercancel", up);
  scene.addEventListener("pointerleave", () => {
    pointer = null;
    element("tip").hidden = true;
  });
  scene.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    move(() => view.zoom(Math.exp(-event.deltaY * lines * 0.0015), ...local(event)));
  }, { passive: false });
}

function listenToButtons() {
  element("zoom-in").addEventListener("click", KEYS["+"]);
  element("zoom-out").addEventListener("click", KEYS["-"]);
  element("fit").addEventListener("click", fit);
  element("theme").addEventListener("click", switchTheme);
  element("help").addEventListener("click", KEYS["?"]);
  element("play").addEventListener("click", KEYS[" "]);
  slider.addEventListener("input", () => {
    setPlaying(false);
    moment.seek((slider.value / STEPS) * run.end);
    touch();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    fillLegend(run, colours());
    touch();
  });
}
