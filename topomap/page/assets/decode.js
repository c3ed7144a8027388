// From the whole numbers of the page to metres, seconds and radians.

const RADIANS = Math.PI / 18000;

function sums(differences, scale) {
  const found = new Float64Array(differences.length);
  let sum = 0;
  for (let k = 0; k < differences.length; k++) {
    sum += differences[k];
    found[k] = sum * scale;
  }
  return found;
}

function decodeRobot(raw, number) {
  return {
    number,
    name: raw.name,
    radius: raw.radius / 1000,
    t: sums(raw.t, 1e-3),
    x: sums(raw.x, 1e-3),
    y: sums(raw.y, 1e-3),
    h: sums(raw.h, RADIANS),
    rangers: raw.rangers.map(([x, y, yaw]) => ({ x: x / 1000, y: y / 1000, yaw: yaw * RADIANS })),
    ranges: raw.ranges,
  };
}

function decodeMap(raw, number) {
  const states = raw.states.map((state) => ({
    t: state.t / 1000,
    glide: state.glide / 1000,
    place: { angle: state.place[0] * RADIANS, x: state.place[1] / 1000, y: state.place[2] / 1000 },
    vertices: state.vertices,
    edges: state.edges,
    v: state.v,
    e: state.e,
  }));
  return { number, name: raw.name, until: raw.until === null ? Infinity : raw.until / 1000, states };
}

function decodeVertex(row, types) {
  const [, id, type, x, y, exits, unexplored, long, short, tilt] = row;
  return {
    id,
    type: types[type],
    x: x / 1000,
    y: y / 1000,
    exits: exits.map((way) => way * RADIANS),
    unexplored: unexplored.map((way) => way * RADIANS),
    region: long === undefined ? null : { long: long / 1000, short: short / 1000, tilt: tilt * RADIANS },
  };
}

function decodeEdge(row) {
  const [, source, target, leaves, arrives, behaviour, length, sigma, count, shift, clearance] = row;
  return {
    source,
    target,
    leaves: leaves * RADIANS,
    arrives: arrives * RADIANS,
    behaviour,
    length: length / 1000,
    sigma: sigma / 1000,
    count,
    shift: shift / 1000,
    clearance: clearance === null ? null : clearance / 1000,
  };
}

function decode(raw) {
  return {
    title: raw.title,
    unit: raw.unit,
    end: raw.end / 1000,
    facts: raw.facts,
    types: raw.types,
    walls: raw.walls.map((ring) => Float64Array.from(ring, (value) => value / 1000)),
    robots: raw.robots.map(decodeRobot),
    maps: raw.maps.map(decodeMap),
    hypotheses: raw.hypotheses.map((track) => ({
      name: track.name,
      t: sums(track.t, 1e-3),
      belief: track.belief.map((value) => value / 1000),
      plausibility: track.plausibility.map((value) => value / 1000),
      accepted: track.accepted,
    })),
    matches: raw.matches.map(([t, mapA, a, mapB, b, group, note]) => ({ t: t / 1000, mapA, a, mapB, b, group, note })),
    assignments: raw.assignments.map(([t, robot, target, reason]) => ({
      t: t / 1000,
      robot,
      target: target && { x: target[0] / 1000, y: target[1] / 1000 },
      reason,
    })),
    messages: raw.messages.map(([t, text, sender, receiver, lost]) => ({ t: t / 1000, text, sender, receiver, lost })),
  };
}
