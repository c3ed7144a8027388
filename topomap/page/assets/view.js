// Which part of the world is on the screen.

class View {
  constructor() {
    this.scale = 50;
    this.x = 0;
    this.y = 0;
    this.width = 1;
    this.height = 1;
  }

  toScreen(x, y) {
    return [(x - this.x) * this.scale + this.width / 2, this.height / 2 - (y - this.y) * this.scale];
  }

  toWorld(px, py) {
    return [(px - this.width / 2) / this.scale + this.x, (this.height / 2 - py) / this.scale + this.y];
  }

  fit(box) {
    const wide = Math.max(box.high[0] - box.low[0], 1e-3);
    const high = Math.max(box.high[1] - box.low[1], 1e-3);
    const rim = Math.min(56, 0.08 * Math.min(this.width, this.height));
    this.scale = Math.min((this.width - 2 * rim) / wide, (this.height - 2 * rim) / high, 400);
    this.x = (box.low[0] + box.high[0]) / 2;
    this.y = (box.low[1] + box.high[1]) / 2;
  }

  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }

  // Zoom so that what is under the pointer stays there.
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const [x, y] = this.toWorld(px, py);
    this.scale = Math.min(Math.max(this.scale * factor, 1e-3), 5000);
    const [nx, ny] = this.toWorld(px, py);
    this.x += x - nx;
    this.y += y - ny;
  }

  sees(px, py, rim = 30) {
    return px > -rim && py > -rim && px < this.width + rim && py < this.height + rim;
  }
}

// The least box around all that is ever shown.
function boxOf(run) {
  const low = [Infinity, Infinity];
  const high = [-Infinity, -Infinity];
  const take = (x, y) => {
    low[0] = Math.min(low[0], x);
    low[1] = Math.min(low[1], y);
    high[0] = Math.max(high[0], x);
    high[1] = Math.max(high[1], y);
  };
  for (const ring of run.walls) {
    for (let k = 0; k < ring.length; k += 2) take(ring[k], ring[k + 1]);
  }
  for (const robot of run.robots) robot.x.forEach((x, k) => take(x, robot.y[k]));
  if (!run.walls.length) {
    for (const chart of run.maps) {
      const seen = [];
      for (const state of chart.states) {
        for (const row of state.v) seen[row[0]] = row;
        for (const row of seen.slice(0, state.vertices)) take(...moved(state.place, row[3] / 1000, row[4] / 1000));
      }
    }
  }
  for (const sent of run.assignments) if (sent.target) take(sent.target.x, sent.target.y);
  return low[0] <= high[0] ? { low, high } : { low: [-1, -1], high: [1, 1] };
}
