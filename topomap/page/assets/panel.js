// The words around the picture. Text only: nothing of a recording becomes markup.

const element = (id) => document.getElementById(id);

function make(tag, text = "", className = "") {
  const found = document.createElement(tag);
  found.textContent = text;
  if (className) found.className = className;
  return found;
}

function fillHead(run) {
  element("title").textContent = run.title || "topomap";
  for (const [name, value] of run.facts) {
    const row = make("div");
    const mood = { correct: "good", accepted: "good", "not correct": "bad", refused: "bad", "not closed": "bad" }[value];
    row.append(make("dt", name), make("dd", value, mood || ""));
    element("facts").append(row);
  }
}

// The words about one thing, as a list of definitions.
function about(thing) {
  const box = make("div", "", "about");
  const list = make("dl");
  for (const [name, value] of thing.rows) list.append(make("dt", name), make("dd", value));
  box.append(make("b", thing.title), list);
  return box;
}

const HINT = matchMedia("(pointer: coarse)").matches
  ? "Tap a vertex, an edge or a robot."
  : "Point at a vertex, an edge or a robot, or press N.";

function showChosen(thing) {
  element("chosen").replaceChildren(thing ? about(thing) : make("p", HINT, "quiet"));
}

function showTip(thing, pointer, { width, height }) {
  const tip = element("tip");
  tip.hidden = !thing;
  if (!thing) return;
  const [px, py] = pointer;
  tip.replaceChildren(about(thing));
  const { offsetWidth, offsetHeight } = tip;
  const left = px + 16 + offsetWidth > width ? px - 16 - offsetWidth : px + 16;
  const top = py + 16 + offsetHeight > height ? py - 16 - offsetHeight : py + 16;
  tip.style.left = `${Math.max(4, left)}px`;
  tip.style.top = `${Math.max(4, top)}px`;
}

// Boxes that show and hide parts of the picture; only of what there is.
function fillLayers(run, shown, redraw) {
  const add = (label, isThere, read, write) => {
    if (!isThere) return;
    const row = make("label");
    const box = make("input");
    box.type = "checkbox";
    box.checked = read();
    box.addEventListener("change", () => {
      write(box.checked);
      redraw();
    });
    row.append(box, label);
    element("layers").append(row);
  };
  const part = (name, label, isThere) => add(label, isThere, () => shown[name], (value) => (shown[name] = value));
  part("walls", "walls", run.walls.length);
  run.maps.forEach((chart, k) => add(chart.name, true, () => shown.maps[k], (value) => (shown.maps[k] = value)));
  part("regions", "95 % regions", run.maps.length);
  part("ids", "ids", run.maps.length);
  part("matches", "matches", run.matches.length);
  part("trails", "trails", run.robots.length);
  part("rays", "rays", run.robots.some((robot) => robot.ranges));
  part("assignments", "targets", run.assignments.length);
  part("messages", "messages", run.messages.some((message) => message.sender !== null));
}

// The marks of the types that occur, drawn as in the picture.
function fillLegend(run, palette) {
  const types = new Set();
  for (const chart of run.maps) for (const state of chart.states) for (const row of state.v) types.add(run.types[row[2]]);
  element("legend").replaceChildren();
  for (const type of run.types) {
    if (!types.has(type)) continue;
    const row = make("li");
    const mark = make("canvas");
    mark.style.width = mark.style.height = "14px";
    const ctx = sized(mark, 14, 14);
    const path = new Path2D();
    addMark(path, type, 7, 7, 4.5);
    ctx.fillStyle = palette.types[type] || palette.ink;
    ctx.fill(path);
    row.append(mark, `${type}, ${MEANING[type] || ""}`);
    element("legend").append(row);
  }
}

function showTeam(moment, palette) {
  const { robots, assignments } = moment.run;
  element("team").hidden = robots.length < 2 && !assignments.length;
  if (element("team").hidden) return;
  element("robots").replaceChildren(
    ...robots.map((robot, k) => {
      const row = make("li");
      const swatch = make("span", "", "swatch");
      swatch.style.background = colourOf(palette, robots.length > 1 ? k : 1);
      const sent = moment.sent[k];
      const doing = !sent ? "" : sent.target ? sent.reason || "on its way" : sent.reason || "stays";
      row.append(swatch, make("span", doing ? `${robot.name}: ${doing}` : robot.name));
      return row;
    }),
  );
}

const LOG_ROWS = 60;

// What was said up to now, the newest first.
function showLog(moment, goTo) {
  const { run, messages } = moment;
  element("said").hidden = !run.messages.length;
  const log = element("log");
  if (log.dataset.upTo === String(messages)) return;
  log.dataset.upTo = messages;
  const rows = run.messages.slice(Math.max(0, messages - LOG_ROWS), messages).reverse();
  log.replaceChildren(
    ...rows.map(({ t, text, sender, receiver, lost }) => {
      const row = make("li");
      const who = sender === null ? "" : `${run.robots[sender].name}${receiver === null ? "" : ` to ${run.robots[receiver].name}`}: `;
      row.append(make("time", clockText(t, run.unit)), make("span", `${who}${text}${lost ? " (lost)" : ""}`));
      row.addEventListener("click", () => goTo(t));
      return row;
    }),
  );
}
