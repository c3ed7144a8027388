// Draw what moves: robots, their trails and rays, where they are sent, what they say.

const LINGER = 0.015; // a message is seen for this part of the run

function drawTrail(ctx, view, robot, pose, colour) {
  ctx.beginPath();
  for (let k = 0; k <= pose.k; k++) {
    const [px, py] = view.toScreen(robot.x[k], robot.y[k]);
    if (k) ctx.lineTo(px, py);
    else ctx.moveTo(px, py);
  }
  ctx.lineTo(...view.toScreen(pose.x, pose.y));
  ctx.strokeStyle = colour;
  ctx.globalAlpha = 0.32;
  ctx.lineWidth = 2;
  ctx.lineJoin = "round";
  ctx.stroke();
  ctx.globalAlpha = 1;
}

// Where the beams of a robot end, in the world; those that met nothing are left out.
function hitsOf(robot, pose) {
  if (!robot.ranges) return [];
  const c = Math.cos(pose.h);
  const s = Math.sin(pose.h);
  return robot.rangers.flatMap((ranger, k) => {
    const range = robot.ranges[k][pose.k] / 100;
    if (range < 0) return [];
    const x = pose.x + c * ranger.x - s * ranger.y;
    const y = pose.y + s * ranger.x + c * ranger.y;
    const way = pose.h + ranger.yaw;
    return [{ x, y, range, hx: x + range * Math.cos(way), hy: y + range * Math.sin(way), ranger: k }];
  });
}

function drawRays(ctx, view, robot, pose, palette) {
  ctx.strokeStyle = ctx.fillStyle = palette.ray;
  ctx.lineWidth = 1.6;
  for (const hit of hitsOf(robot, pose)) {
    const end = view.toScreen(hit.hx, hit.hy);
    ctx.beginPath();
    ctx.moveTo(...view.toScreen(hit.x, hit.y));
    ctx.lineTo(...end);
    ctx.stroke();
    ctx.beginPath();
    ctx.arc(...end, 2.6, 0, 2 * Math.PI);
    ctx.fill();
  }
}

function robotSize(view, robot) {
  return Math.max(robot.radius * view.scale, 6);
}

function drawRobot(ctx, view, robot, pose, colour, palette) {
  const [px, py] = view.toScreen(pose.x, pose.y);
  const r = robotSize(view, robot);
  ctx.beginPath();
  ctx.arc(px, py, r, 0, 2 * Math.PI);
  ctx.fillStyle = colour;
  ctx.fill();
  ctx.strokeStyle = palette.halo;
  ctx.lineWidth = 1.5;
  ctx.stroke();
  const nose = (turn, part) => [px + part * r * Math.cos(-pose.h + turn), py + part * r * Math.sin(-pose.h + turn)];
  ctx.beginPath();
  polygon(ctx, [...nose(0, 0.85), ...nose(2.5, 0.65), ...nose(Math.PI, 0.2), ...nose(-2.5, 0.65)]);
  ctx.fillStyle = palette.halo;
  ctx.fill();
}

function drawAssignment(ctx, view, sent, pose, colour) {
  const [tx, ty] = view.toScreen(sent.target.x, sent.target.y);
  const [px, py] = view.toScreen(pose.x, pose.y);
  ctx.strokeStyle = ctx.fillStyle = colour;
  ctx.lineWidth = 2;
  ctx.beginPath();
  ctx.arc(tx, ty, 7, 0, 2 * Math.PI);
  ctx.stroke();
  const way = Math.atan2(ty - py, tx - px);
  if (Math.hypot(tx - px, ty - py) < 24) return;
  ctx.setLineDash([7, 4]);
  arrow(ctx, px, py, tx - 9 * Math.cos(way), ty - 9 * Math.sin(way), 10);
  ctx.setLineDash([]);
}

function drawMessages(ctx, view, moment, palette) {
  const { run, t, poses } = moment;
  const since = t - LINGER * run.end;
  for (let k = moment.messages - 1; k >= 0 && run.messages[k].t >= since; k--) {
    const { sender, receiver, lost } = run.messages[k];
    if (sender === null) continue;
    const [px, py] = view.toScreen(poses[sender].x, poses[sender].y);
    ctx.strokeStyle = lost ? palette.lost : palette.good;
    ctx.lineWidth = 1.6;
    ctx.setLineDash(lost ? [2, 4] : []);
    ctx.beginPath();
    if (receiver === null) ctx.arc(px, py, 18, 0, 2 * Math.PI);
    else {
      ctx.moveTo(px, py);
      ctx.lineTo(...view.toScreen(poses[receiver].x, poses[receiver].y));
    }
    ctx.stroke();
    ctx.setLineDash([]);
  }
}

// The whole picture at one moment.
function drawScene(ctx, view, moment, palette, shown, chosen) {
  const { run } = moment;
  const several = run.maps.length > 1;
  drawWalls(ctx, view, shown.walls ? run : { ...run, walls: [] }, palette);
  const robotColour = (k) => colourOf(palette, run.robots.length > 1 ? k : 1);
  if (shown.trails) run.robots.forEach((robot, k) => drawTrail(ctx, view, robot, moment.poses[k], robotColour(k)));
  moment.maps.forEach((chart, k) => {
    if (chart.state >= 0 && shown.maps[k]) drawMap(ctx, view, chart, palette, shown, several ? colourOf(palette, k) : null);
  });
  if (shown.matches) drawMatches(ctx, view, moment, palette);
  run.robots.forEach((robot, k) => {
    const sent = moment.sent[k];
    if (shown.rays) drawRays(ctx, view, robot, moment.poses[k], palette);
    if (shown.assignments && sent && sent.target) drawAssignment(ctx, view, sent, moment.poses[k], robotColour(k));
  });
  if (shown.messages) drawMessages(ctx, view, moment, palette);
  run.robots.forEach((robot, k) => drawRobot(ctx, view, robot, moment.poses[k], robotColour(k), palette));
  if (chosen) drawChosen(ctx, view, chosen, palette);
  drawScale(ctx, view, palette);
}

function drawChosen(ctx, view, chosen, palette) {
  ctx.strokeStyle = palette.ink;
  ctx.lineWidth = 2;
  ctx.beginPath();
  if (chosen.line) {
    const [x0, y0, x1, y1] = chosen.line;
    ctx.moveTo(...view.toScreen(x0, y0));
    ctx.lineTo(...view.toScreen(x1, y1));
    ctx.lineWidth = 4;
    ctx.globalAlpha = 0.5;
  } else {
    const [px, py] = view.toScreen(chosen.x, chosen.y);
    ctx.arc(px, py, 11, 0, 2 * Math.PI);
  }
  ctx.stroke();
  ctx.globalAlpha = 1;
}
