// What holds at one moment: where robots are, how far maps have grown.

// The last index whose time is not after t; -1 before the first.
function lastBefore(times, t) {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

function poseAt(robot, t) {
  const k = Math.max(0, lastBefore(robot.t, t));
  const next = Math.min(k + 1, robot.t.length - 1);
  const gap = robot.t[next] - robot.t[k];
  const share = gap > 0 ? Math.min(Math.max((t - robot.t[k]) / gap, 0), 1) : 0;
  const between = (values) => values[k] + share * (values[next] - values[k]);
  return { k, x: between(robot.x), y: between(robot.y), h: between(robot.h) };
}

function moved(place, x, y) {
  const c = Math.cos(place.angle);
  const s = Math.sin(place.angle);
  return [c * x - s * y + place.x, s * x + c * y + place.y];
}

// Between two placements the way is straight and the turn the shorter one.
function blended(from, to, share) {
  const turn = Math.atan2(Math.sin(to.angle - from.angle), Math.cos(to.angle - from.angle));
  const ease = share * share * (3 - 2 * share);
  return {
    angle: from.angle + ease * turn,
    x: from.x + ease * (to.x - from.x),
    y: from.y + ease * (to.y - from.y),
  };
}

// A map at the time it was last asked for: states are applied one after another.
class MapNow {
  constructor(track, types) {
    this.track = track;
    this.types = types;
    this.times = track.states.map((state) => state.t);
    this.reset();
  }

  reset() {
    this.state = -1;
    this.vertices = [];
    this.edges = [];
    this.byId = new Map();
    this.place = null;
  }

  seek(t) {
    const { states, until } = this.track;
    const wanted = t >= until ? -1 : lastBefore(this.times, t);
    if (wanted < this.state) this.reset();
    const isNew = wanted > this.state;
    while (this.state < wanted) this.apply(states[++this.state]);
    if (wanted < 0) return;
    const next = states[wanted + 1];
    let place = states[wanted].place;
    if (next && next.glide > 0 && t > next.t - next.glide) {
      place = blended(place, next.place, (t - next.t + next.glide) / next.glide);
    }
    if (isNew || !this.place || place.angle !== this.place.angle || place.x !== this.place.x || place.y !== this.place.y) {
      this.settle(place);
    }
  }

  apply(state) {
    this.vertices.length = state.vertices;
    this.edges.length = state.edges;
    for (const row of state.v) this.vertices[row[0]] = decodeVertex(row, this.types);
    for (const row of state.e) this.edges[row[0]] = decodeEdge(row);
  }

  // Put every vertex where it lies in the world.
  settle(place) {
    this.place = place;
    this.byId = new Map();
    for (const vertex of this.vertices) {
      [vertex.wx, vertex.wy] = moved(place, vertex.x, vertex.y);
      this.byId.set(vertex.id, vertex);
    }
  }
}

class Moment {
  constructor(run) {
    this.run = run;
    this.maps = run.maps.map((track) => new MapNow(track, run.types));
    this.assigned = run.robots.map(() => []);
    for (const sent of run.assignments) this.assigned[sent.robot].push(sent);
    this.messageTimes = run.messages.map((message) => message.t);
    this.seek(run.end);
  }

  seek(t) {
    this.t = t;
    for (const chart of this.maps) chart.seek(t);
    this.poses = this.run.robots.map((robot) => poseAt(robot, t));
    this.sent = this.assigned.map((list) => list[lastBefore(list.map((sent) => sent.t), t)] || null);
    this.matches = this.run.matches.filter((match) => match.t <= t && this.ends(match));
    this.messages = lastBefore(this.messageTimes, t) + 1;
  }

  ends(match) {
    const a = this.maps[match.mapA].byId.get(match.a);
    const b = this.maps[match.mapB].byId.get(match.b);
    return a && b ? [a, b] : null;
  }
}
