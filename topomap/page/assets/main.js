// Put it together: read the recording, answer to the hand, draw when something changed.

const run = decode(JSON.parse(element("recording").textContent));
const moment = new Moment(run);
const view = new View();
const scene = element("scene");
const slider = element("slider");
const shown = {
  walls: true, regions: true, ids: true, matches: true, trails: true, rays: true,
  assignments: true, messages: true, maps: run.maps.map(() => true),
};
const box = boxOf(run);
const STEPS = 10000; // of the slider
const PLAY_TIME = 40; // seconds that a run plays, about, unless told otherwise

let chosenKey = null;
let pointer = null; // where the mouse rests on the picture, in pixels
let isDirty = true;
let isPlaying = false;
let isFitted = true;
let lastFrame = 0;
let speed = 1;

const touch = () => (isDirty = true);

function goTo(t) {
  moment.seek(Math.min(Math.max(t, 0), run.end));
  slider.value = run.end ? Math.round((moment.t / run.end) * STEPS) : 0;
  touch();
}

function choose(thing) {
  chosenKey = thing ? thing.key : null;
  touch();
}

function draw() {
  const palette = colours();
  const ctx = sized(scene, view.width, view.height);
  const chosen = chosenKey && again(moment, chosenKey);
  ctx.save();
  drawScene(ctx, view, moment, palette, shown, chosen);
  ctx.restore();
  showChosen(chosen);
  showTip(pointer && find(view, moment, shown, ...pointer), pointer, view);
  showTeam(moment, palette);
  showLog(moment, goTo);
  const text = clockText(moment.t, run.unit);
  element("clock").textContent = run.end ? `${text} / ${clockText(run.end, run.unit)}` : "";
  slider.setAttribute("aria-valuetext", text);
  scene.setAttribute("aria-label", summary(text));
  scene.dataset.view = `${view.x} ${view.y} ${view.scale}`; // middle in metres, pixels a metre
  if (beliefChart) beliefChart.draw(moment.t, palette);
}

function summary(time) {
  const grown = moment.maps.filter((chart) => chart.state >= 0);
  const parts = grown.map((chart) => `${chart.track.name}: ${chart.vertices.length} vertices, ${chart.edges.length} edges`);
  return `${run.title}${run.end ? ` at ${time}` : ""}. ${parts.join("; ")}`;
}

function frame(now) {
  if (isPlaying) {
    goTo(moment.t + ((now - lastFrame) / 1000) * speed);
    if (moment.t >= run.end) setPlaying(false);
  }
  lastFrame = now;
  if (isDirty) {
    isDirty = false;
    draw();
  }
  requestAnimationFrame(frame);
}

function setPlaying(wanted) {
  if (wanted && moment.t >= run.end) goTo(0);
  isPlaying = wanted && run.end > 0;
  element("play").textContent = isPlaying ? "\u275a\u275a" : "\u25b6";
  element("play").setAttribute("aria-label", isPlaying ? "Stop" : "Play");
}

// The times at which something changes at once.
const events = [...new Set([
  0, run.end,
  ...run.maps.flatMap((chart) => chart.states.map((state) => state.t)),
  ...[...run.messages, ...run.assignments, ...run.matches].map((thing) => thing.t),
])].sort((a, b) => a - b);

function step(way) {
  setPlaying(false);
  const next = way > 0 ? events.find((t) => t > moment.t + 1e-6) : events.findLast((t) => t < moment.t - 1e-6);
  if (next !== undefined) goTo(next);
}

// Choose the vertex after, or before, the one that is chosen.
function nextVertex(way) {
  const all = moment.maps.flatMap((chart, k) => (shown.maps[k] ? chart.vertices.map((vertex) => [k, vertex]) : []));
  if (!all.length) return;
  const here = all.findIndex(([k, vertex]) => `v${k}:${vertex.id}` === chosenKey);
  const [k, vertex] = all[here < 0 ? (way > 0 ? 0 : all.length - 1) : (here + way + all.length) % all.length];
  choose(aboutVertex(moment, k, vertex));
  if (!view.sees(...view.toScreen(vertex.wx, vertex.wy), -20)) {
    view.x = vertex.wx;
    view.y = vertex.wy;
    isFitted = false;
  }
}

function move(change) {
  isFitted = false;
  change();
  touch();
}

function fit() {
  isFitted = true;
  view.fit(box);
  touch();
}

function switchTheme() {
  document.documentElement.dataset.theme = isDark() ? "light" : "dark";
  fillLegend(run, colours());
  touch();
}

// Speeds around the one at which the run takes a bearable while.
function fillSpeeds() {
  const tens = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000];
  speed = tens.findLast((factor) => factor <= Math.max(run.end / PLAY_TIME, 1));
  const fitting = [...new Set([1, speed / 5, speed / 2, speed, speed * 2, speed * 5])].filter((factor) => factor >= 0.2);
  for (const factor of fitting.sort((a, b) => a - b)) {
    const option = make("option", `${+factor.toFixed(1)}\u00d7`);
    option.value = factor;
    option.selected = factor === speed;
    element("speed").append(option);
  }
  element("speed").addEventListener("change", (event) => (speed = Number(event.target.value)));
}

const beliefChart = run.hypotheses.length ? new BeliefChart(element("belief"), element("believed"), run, goTo) : null;
element("beliefs").hidden = !beliefChart;
element("player").hidden = !run.end;
slider.max = STEPS;
fillHead(run);
fillLayers(run, shown, touch);
fillLegend(run, colours());
fillSpeeds();
listenToKeys();
listenToPointers();
listenToButtons();

new ResizeObserver(() => {
  const { width, height } = element("stage").getBoundingClientRect();
  view.width = Math.max(width, 1);
  view.height = Math.max(height, 1);
  if (isFitted) view.fit(box);
  draw();
  performance.mark("drawn");
}).observe(element("stage"));

const asked = /^#t=([\d.]+)$/.exec(location.hash);
goTo(asked ? Number(asked[1]) : run.end);
requestAnimationFrame(frame);
