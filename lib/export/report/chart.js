// The share of states that tolerate each length of silence: the sizes of the layers.

class Chart {
  constructor(canvas, reading) {
    this.plot = new Plot(canvas);
    this.reading = reading;
    this.step = 1;
    canvas.addEventListener("pointermove", (event) => this.pointAt(event));
    canvas.addEventListener("pointerdown", (event) => this.pointAt(event));
    canvas.addEventListener("keydown", (event) => this.press(event));
  }

  show(partition) {
    this.partition = partition;
    this.move(Math.min(this.step, partition.layers.length - 1));
  }

  move(step) {
    const { layers } = this.partition;
    this.step = Math.max(0, Math.min(step, layers.length - 1));
    const bearing = layers[this.step];
    const states = layers[0] === 1 ? "state" : "states";
    this.reading.textContent =
      `${timeText(this.step)}: ${grouped(bearing)} of ${grouped(layers[0])} ${states} ` +
      `(${shareText(bearing, layers[0])}) ${bearing === 1 ? "tolerates" : "tolerate"} this much silence.`;
    this.draw();
  }

  draw() {
    const { layers } = this.partition;
    const { plot } = this;
    plot.begin((width) => Math.min(260, Math.max(160, width * 0.4)), kMargin);
    const { left, top, width, height } = plot.frame;
    const { context } = plot;
    const barWidth = width / layers.length;
    for (const [k, size] of layers.entries()) {
      const barHeight = (size / layers[0]) * height;
      context.fillStyle = themeColor(k === this.step ? "--mark" : "--accent");
      const gap = barWidth > 6 ? 1 : 0;
      // Neighbours overlap a little where they have no gap, so that no light comes through.
      context.fillRect(left + k * barWidth + gap / 2, top + height - barHeight, barWidth - gap + (gap ? 0 : 0.5), barHeight);
    }
    const unit = data.unit === "" ? 1 : data.period;
    const steps = ticksBetween(0, layers.length - 1, width / 90).filter(Number.isInteger);
    plot.acrossAxis(
      steps.map((k) => [(k + 0.5) / layers.length, numberText(k * unit)]),
      data.unit === "" ? "silence [steps]" : `silence [${data.unit}]`,
    );
    plot.upAxis([0, 25, 50, 75, 100].map((percent) => [percent / 100, `${percent} %`]), "states");
  }

  pointAt(event) {
    const [x] = this.plot.placeOf(event);
    if (x >= 0 && x < 1) this.move(Math.floor(x * this.partition.layers.length));
  }

  press(event) {
    const moves = { ArrowLeft: -1, ArrowRight: 1, Home: -Infinity, End: Infinity };
    if (!(event.key in moves) || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    const size = event.shiftKey ? 10 : 1;
    this.move(this.step + size * moves[event.key]);
  }
}

function shareText(part, whole) {
  const percent = (100 * part) / whole;
  if (part === 0 || part === whole) return `${percent} %`;
  if (percent < 0.1) return "less than 0.1 %";
  if (percent > 99.9) return "more than 99.9 %";
  return `${percent.toFixed(percent < 10 || percent > 90 ? 1 : 0)} %`;
}
