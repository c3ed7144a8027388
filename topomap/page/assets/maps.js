// Draw walls and maps.

const ARROW = 0.5; // metres of an unexplored exit
const MANY = 150; // with more vertices in sight, ids would hide the map

function markSize(view) {
  return Math.min(Math.max(view.scale * 0.085, 1.6), 6.5);
}

function drawWalls(ctx, view, run, palette) {
  ctx.fillStyle = run.walls.length ? palette.outside : palette.free;
  ctx.fillRect(0, 0, view.width + 1, view.height + 1);
  if (!run.walls.length) return drawGrid(ctx, view, palette);
  const path = new Path2D();
  for (const ring of run.walls) {
    for (let k = 0; k < ring.length; k += 2) {
      const [px, py] = view.toScreen(ring[k], ring[k + 1]);
      if (k) path.lineTo(px, py);
      else path.moveTo(px, py);
    }
    path.closePath();
  }
  ctx.fillStyle = palette.free;
  ctx.fill(path, "evenodd");
  ctx.save();
  ctx.clip(path, "evenodd");
  drawGrid(ctx, view, palette);
  ctx.restore();
  ctx.strokeStyle = palette.wall;
  ctx.lineWidth = 1.5;
  ctx.stroke(path);
}

// The step of the grid: 1, 2 or 5 times a power of ten, at least so many pixels.
function gridStep(view, pixels) {
  const least = pixels / view.scale;
  const ten = 10 ** Math.floor(Math.log10(least));
  return ten * [1, 2, 5, 10].find((part) => part * ten >= least);
}

function drawGrid(ctx, view, palette) {
  const step = gridStep(view, 36);
  const [left, top] = view.toWorld(0, 0);
  const [right, bottom] = view.toWorld(view.width, view.height);
  ctx.beginPath();
  for (let x = Math.ceil(left / step) * step; x < right; x += step) {
    const px = Math.round(view.toScreen(x, 0)[0]) + 0.5;
    ctx.moveTo(px, 0);
    ctx.lineTo(px, view.height);
  }
  for (let y = Math.ceil(bottom / step) * step; y < top; y += step) {
    const py = Math.round(view.toScreen(0, y)[1]) + 0.5;
    ctx.moveTo(0, py);
    ctx.lineTo(view.width, py);
  }
  ctx.strokeStyle = palette.grid;
  ctx.lineWidth = 1;
  ctx.stroke();
}

function drawScale(ctx, view, palette) {
  const step = gridStep(view, 60);
  const [x, y, wide] = [16, view.height - 16, step * view.scale];
  ctx.strokeStyle = ctx.fillStyle = palette.soft;
  ctx.lineWidth = 1.5;
  ctx.beginPath();
  ctx.moveTo(x, y - 5);
  ctx.lineTo(x, y);
  ctx.lineTo(x + wide, y);
  ctx.lineTo(x + wide, y - 5);
  ctx.stroke();
  ctx.font = "12px system-ui, sans-serif";
  ctx.textAlign = "center";
  ctx.fillText(step >= 1 ? `${step} m` : `${+(step * 100).toFixed(1)} cm`, x + wide / 2, y - 6);
}

// Draw one map; with several, its edges have the map's own colour.
function drawMap(ctx, view, chart, palette, shown, ownColour) {
  const at = [];
  const inSight = [];
  for (const vertex of chart.vertices) {
    const place = view.toScreen(vertex.wx, vertex.wy);
    at.push(place);
    vertex.px = place[0];
    vertex.py = place[1];
    if (view.sees(...place)) inSight.push(vertex);
  }
  if (shown.regions) drawRegions(ctx, view, chart, inSight, palette);
  ctx.beginPath();
  for (const edge of chart.edges) {
    const a = chart.byId.get(edge.source);
    const b = chart.byId.get(edge.target);
    ctx.moveTo(a.px, a.py);
    ctx.lineTo(b.px, b.py);
  }
  ctx.strokeStyle = ownColour || palette.edge;
  ctx.lineWidth = ownColour ? 2.2 : 1.6;
  ctx.stroke();
  drawOpenExits(ctx, view, chart, inSight, palette);
  const r = markSize(view);
  for (const type of new Set(inSight.map((vertex) => vertex.type))) {
    const path = new Path2D();
    for (const vertex of inSight) if (vertex.type === type) addMark(path, type, vertex.px, vertex.py, r);
    ctx.fillStyle = palette.types[type] || palette.ink;
    ctx.fill(path);
    if (r > 3) {
      ctx.strokeStyle = palette.halo;
      ctx.lineWidth = 1;
      ctx.stroke(path);
    }
  }
  if (shown.ids && inSight.length <= MANY && view.scale > 12) drawIds(ctx, inSight, palette, r);
}

function drawRegions(ctx, view, chart, vertices, palette) {
  ctx.beginPath();
  for (const { region, px, py } of vertices) {
    if (!region || region.long * view.scale < 2) continue;
    const tilt = -(region.tilt + chart.place.angle);
    const long = region.long * view.scale;
    ctx.moveTo(px + long * Math.cos(tilt), py + long * Math.sin(tilt));
    ctx.ellipse(px, py, long, Math.max(region.short * view.scale, 0.5), tilt, 0, 2 * Math.PI);
  }
  ctx.fillStyle = palette.region;
  ctx.fill("nonzero");
  ctx.strokeStyle = palette.rim;
  ctx.lineWidth = 0.7;
  ctx.stroke();
}

function drawOpenExits(ctx, view, chart, vertices, palette) {
  ctx.strokeStyle = ctx.fillStyle = palette.open;
  ctx.lineWidth = 1.8;
  const length = Math.min(Math.max(ARROW * view.scale, 8), 34);
  for (const vertex of vertices) {
    for (const way of vertex.unexplored) {
      const angle = -(way + chart.place.angle);
      arrow(ctx, vertex.px, vertex.py, vertex.px + length * Math.cos(angle), vertex.py + length * Math.sin(angle));
    }
  }
}

function arrow(ctx, x0, y0, x1, y1, head = 7) {
  const angle = Math.atan2(y1 - y0, x1 - x0);
  ctx.beginPath();
  ctx.moveTo(x0, y0);
  ctx.lineTo(x1 - head * 0.7 * Math.cos(angle), y1 - head * 0.7 * Math.sin(angle));
  ctx.stroke();
  ctx.beginPath();
  polygon(ctx, [
    x1, y1,
    x1 - head * Math.cos(angle - 0.45), y1 - head * Math.sin(angle - 0.45),
    x1 - head * Math.cos(angle + 0.45), y1 - head * Math.sin(angle + 0.45),
  ]);
  ctx.fill();
}

function drawIds(ctx, vertices, palette, r) {
  ctx.font = "11px system-ui, sans-serif";
  ctx.textAlign = "left";
  ctx.lineWidth = 3;
  ctx.strokeStyle = palette.halo;
  ctx.fillStyle = palette.soft;
  ctx.lineJoin = "round";
  for (const vertex of vertices) {
    ctx.strokeText(vertex.id, vertex.px + r + 2, vertex.py - r);
    ctx.fillText(vertex.id, vertex.px + r + 2, vertex.py - r);
  }
}

function drawMatches(ctx, view, moment, palette) {
  const r = markSize(view) + 4;
  for (const match of moment.matches) {
    const [a, b] = moment.ends(match);
    const [ax, ay] = view.toScreen(a.wx, a.wy);
    const [bx, by] = view.toScreen(b.wx, b.wy);
    ctx.strokeStyle = colourOf(palette, match.group + 2);
    ctx.lineWidth = 2;
    ctx.globalAlpha = 0.85;
    ctx.beginPath();
    ctx.moveTo(ax + r, ay);
    ctx.arc(ax, ay, r, 0, 2 * Math.PI);
    ctx.moveTo(bx + r, by);
    ctx.arc(bx, by, r, 0, 2 * Math.PI);
    ctx.moveTo(ax, ay);
    ctx.lineTo(bx, by);
    ctx.stroke();
    ctx.globalAlpha = 1;
  }
}
