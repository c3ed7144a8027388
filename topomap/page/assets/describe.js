// Find what lies under a place on the screen, and say in words what it is.

const NEAR = 12; // pixels

const metres = (value) => `${value.toFixed(Math.abs(value) < 10 ? 2 : 1)} m`;

function degrees(angle) {
  const found = Math.round((angle * 180) / Math.PI) % 360;
  return `${found < 0 ? found + 360 : found}\u00b0`;
}

// What can be pointed at: robots first, then vertices, targets, edges.
function find(view, moment, shown, px, py, near = NEAR) {
  const [x, y] = view.toWorld(px, py);
  const reach = near / view.scale;
  let best = null;
  let least = Infinity;
  const offer = (distance, within, make) => {
    if (distance <= within && distance < least) {
      least = distance;
      best = make;
    }
  };
  moment.run.robots.forEach((robot, k) => {
    const pose = moment.poses[k];
    offer(Math.hypot(pose.x - x, pose.y - y), Math.max(robot.radius, reach), () => aboutRobot(moment, k));
  });
  if (best) return best();
  moment.maps.forEach((chart, k) => {
    if (!shown.maps[k]) return;
    for (const vertex of chart.vertices) {
      offer(Math.hypot(vertex.wx - x, vertex.wy - y), reach, () => aboutVertex(moment, k, vertex));
    }
  });
  moment.sent.forEach((sent, k) => {
    if (sent && sent.target) offer(Math.hypot(sent.target.x - x, sent.target.y - y), reach, () => aboutTarget(moment, k));
  });
  if (best) return best();
  moment.maps.forEach((chart, k) => {
    if (!shown.maps[k]) return;
    for (const edge of chart.edges) {
      const a = chart.byId.get(edge.source);
      const b = chart.byId.get(edge.target);
      offer(toSegment(x, y, a.wx, a.wy, b.wx, b.wy), reach * 0.6, () => aboutEdge(moment, k, edge, a, b));
    }
  });
  return best && best();
}

function toSegment(x, y, ax, ay, bx, by) {
  const [ux, uy] = [bx - ax, by - ay];
  const square = ux * ux + uy * uy;
  const share = square ? Math.min(Math.max(((x - ax) * ux + (y - ay) * uy) / square, 0), 1) : 0;
  return Math.hypot(ax + share * ux - x, ay + share * uy - y);
}

function aboutVertex(moment, k, vertex) {
  const chart = moment.maps[k];
  const open = vertex.unexplored.map(degrees);
  const rows = [
    ["type", `${vertex.type}, ${MEANING[vertex.type] || ""}`],
    ["exits", vertex.exits.map((way) => (open.includes(degrees(way)) ? `${degrees(way)} (unexplored)` : degrees(way))).join(", ") || "none"],
    ["place", `${metres(vertex.x)}, ${metres(vertex.y)}`],
  ];
  if (vertex.region) rows.push(["95 % within", metres(vertex.region.long)]);
  if (moment.maps.length > 1) rows.push(["map", chart.track.name]);
  for (const match of moment.matches) {
    const isA = match.mapA === k && match.a === vertex.id;
    const isB = match.mapB === k && match.b === vertex.id;
    if (!isA && !isB) continue;
    const [map, other] = isA ? [match.mapB, match.b] : [match.mapA, match.a];
    rows.push(["same as", `vertex ${other} of ${moment.run.maps[map].name}`]);
    if (match.note) rows.push(["by", match.note]);
  }
  return { key: `v${k}:${vertex.id}`, title: `Vertex ${vertex.id}`, rows, x: vertex.wx, y: vertex.wy };
}

function aboutEdge(moment, k, edge, a, b) {
  const times = edge.count === 1 ? "once" : `${edge.count} times`;
  const rows = [
    ["behaviour", edge.behaviour],
    ["length", `${metres(edge.length)} \u00b1 ${metres(edge.sigma)}`],
    ["measured", times],
    ["leaves", `${edge.source} at ${degrees(edge.leaves)}`],
    ["arrives", `${edge.target} from ${degrees(edge.arrives)}`],
  ];
  if (edge.shift) rows.push(["shift", metres(edge.shift)]);
  if (edge.clearance !== null) rows.push(["clearance", metres(edge.clearance)]);
  if (moment.maps.length > 1) rows.push(["map", moment.run.maps[k].name]);
  const line = [a.wx, a.wy, b.wx, b.wy];
  return { key: `e${k}:${edge.source}:${edge.leaves}`, title: `Edge ${edge.source} \u2013 ${edge.target}`, rows, line };
}

function aboutRobot(moment, k) {
  const robot = moment.run.robots[k];
  const pose = moment.poses[k];
  const rows = [
    ["place", `${metres(pose.x)}, ${metres(pose.y)}`],
    ["heading", degrees(pose.h)],
  ];
  if (robot.ranges) {
    const seen = robot.rangers.map((_, i) => robot.ranges[i][pose.k]);
    rows.push(["rangers", seen.map((range) => (range < 0 ? "\u2013" : metres(range / 100))).join(", ")]);
  }
  const sent = moment.sent[k];
  if (sent && sent.reason) rows.push(["goes there", sent.reason]);
  return { key: `r${k}`, title: robot.name, rows, x: pose.x, y: pose.y };
}

function aboutTarget(moment, k) {
  const sent = moment.sent[k];
  const rows = [["for", moment.run.robots[k].name], ["since", clockText(sent.t, moment.run.unit)]];
  if (sent.reason) rows.push(["why", sent.reason]);
  return { key: `t${k}`, title: "Target", rows, ...sent.target };
}

// Find again, at another time, what was chosen; null where it is no more.
function again(moment, key) {
  const [k, id] = key.slice(1).split(":").map(Number);
  if (key[0] === "r") return aboutRobot(moment, k);
  if (key[0] === "t") return moment.sent[k] && moment.sent[k].target ? aboutTarget(moment, k) : null;
  const chart = moment.maps[k];
  if (key[0] === "v") {
    const vertex = chart.byId.get(id);
    return vertex ? aboutVertex(moment, k, vertex) : null;
  }
  const edge = chart.edges.find((one) => `e${k}:${one.source}:${one.leaves}` === key);
  return edge ? aboutEdge(moment, k, edge, chart.byId.get(edge.source), chart.byId.get(edge.target)) : null;
}

function clockText(t, unit) {
  if (unit !== "s") return `${t.toFixed(1)}${unit && ` ${unit}`}`;
  const whole = Math.floor(t + 1e-6);
  const two = (value) => String(value).padStart(2, "0");
  const hours = Math.floor(whole / 3600);
  const rest = `${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
  return hours ? `${hours}:${rest}` : rest;
}
