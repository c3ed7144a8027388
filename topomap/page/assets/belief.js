// Belief in each hypothesis over time; a click leads to that time.

class BeliefChart {
  constructor(canvas, caption, run, goTo) {
    this.canvas = canvas;
    this.caption = caption;
    this.run = run;
    this.pad = { left: 26, right: 8, top: 8, bottom: 18 };
    const timeAt = (event) => {
      const { left, width } = canvas.getBoundingClientRect();
      const share = (event.clientX - left - this.pad.left) / (width - this.pad.left - this.pad.right);
      return Math.min(Math.max(share, 0), 1) * run.end;
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      goTo(timeAt(event));
    });
    canvas.addEventListener("pointermove", (event) => event.buttons && goTo(timeAt(event)));
  }

  draw(t, palette) {
    const { canvas, run, pad } = this;
    const { width, height } = canvas.getBoundingClientRect();
    const ctx = sized(canvas, width, height);
    const px = (time) => pad.left + (time / (run.end || 1)) * (width - pad.left - pad.right);
    const py = (value) => height - pad.bottom - value * (height - pad.top - pad.bottom);
    ctx.strokeStyle = palette.line;
    ctx.fillStyle = palette.soft;
    ctx.lineWidth = 1;
    ctx.font = "10px system-ui, sans-serif";
    ctx.textAlign = "right";
    for (const value of [0, 0.5, 1]) {
      ctx.beginPath();
      ctx.moveTo(pad.left, py(value));
      ctx.lineTo(width - pad.right, py(value));
      ctx.stroke();
      ctx.fillText(value, pad.left - 5, py(value) + 3.5);
    }
    ctx.fillText(clockText(run.end, run.unit), width - pad.right, height - 4);
    const order = run.hypotheses.map((track, k) => [k, track.accepted.includes(1)]).sort((a, b) => a[1] - b[1]);
    for (const [k, wasAccepted] of order) {
      const colour = wasAccepted ? palette.good : colourOf(palette, k);
      for (const [from, to, alpha] of [[0, t, 1], [t, run.end, 0.25]]) {
        ctx.save();
        ctx.beginPath();
        ctx.rect(px(from), 0, px(to) - px(from), height);
        ctx.clip();
        this.drawTrack(ctx, run.hypotheses[k], px, py, colour, alpha, wasAccepted);
        ctx.restore();
      }
    }
    ctx.strokeStyle = palette.ink;
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.moveTo(px(t), pad.top);
    ctx.lineTo(px(t), height - pad.bottom);
    ctx.stroke();
    this.say(t);
  }

  // A line at the belief, a shade from there up to the plausibility; both in steps.
  drawTrack(ctx, track, px, py, colour, alpha, isBold) {
    const steps = (values) => {
      const found = [];
      values.forEach((value, k) => {
        const until = k + 1 < track.t.length ? track.t[k + 1] : track.belief[k] > 0 ? this.run.end : track.t[k];
        found.push([px(track.t[k]), py(value)], [px(until), py(value)]);
      });
      return found;
    };
    const low = steps(track.belief);
    ctx.beginPath();
    for (const corner of [...low, ...steps(track.plausibility).reverse()]) ctx.lineTo(...corner);
    ctx.fillStyle = colour;
    ctx.globalAlpha = alpha * 0.15;
    ctx.fill();
    ctx.beginPath();
    for (const corner of low) ctx.lineTo(...corner);
    ctx.globalAlpha = alpha;
    ctx.strokeStyle = colour;
    ctx.lineWidth = isBold ? 2.2 : 1.4;
    ctx.stroke();
    ctx.globalAlpha = 1;
  }

  // In words: the most believed, and whether it was acted upon.
  say(t) {
    let best = null;
    for (const track of this.run.hypotheses) {
      const k = lastBefore(track.t, t);
      if (k >= 0 && track.plausibility[k] > 0 && (!best || track.belief[k] > best.belief)) {
        best = { name: track.name, belief: track.belief[k], accepted: track.accepted[k] };
      }
    }
    this.caption.textContent = best
      ? `${best.name}: ${best.belief.toFixed(3)}${best.accepted ? ", accepted" : ""}`
      : "no hypothesis yet";
  }
}

// Fit a canvas to its size on the screen, in real pixels, and return it empty.
function sized(canvas, width, height) {
  const ratio = window.devicePixelRatio || 1;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) {
    canvas.width = w;
    canvas.height = h;
  }
  const ctx = canvas.getContext("2d");
  ctx.setTransform(1, 0, 0, 1, 0, 0);
  ctx.clearRect(0, 0, w, h);
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  return ctx;
}
