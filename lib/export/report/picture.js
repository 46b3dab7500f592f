// A cut through the cells in two dimensions.

const kMargin = { left: 62, right: 14, top: 8, bottom: 48 };
const kMostHeight = 620;

class Picture {
  // @param onPoint called with the positions of a cell under the pointer, null when there is none;
  // @param onChoose likewise with a cell that is clicked
  constructor(canvas, onPoint, onChoose) {
    this.plot = new Plot(canvas);
    this.image = document.createElement("canvas");
    canvas.addEventListener("pointermove", (event) => onPoint(this.cellAt(event)));
    canvas.addEventListener("pointerleave", () => onPoint(null));
    canvas.addEventListener("pointerdown", (event) => {
      const cell = this.cellAt(event);
      if (cell !== null) onChoose(cell);
    });
  }

  // @param across,up {points, step, title, scale}; `up` is null for a strip. @param color of the cell at
  // positions (i, j). Must be followed by draw().
  show(across, up, color) {
    this.across = across;
    this.up = up;
    const width = across.points.length;
    const height = up === null ? 1 : up.points.length;
    const pixels = new ImageData(width, height);
    for (let j = 0; j < height; ++j) {
      for (let i = 0; i < width; ++i) pixels.data.set([...color(i, j), 255], 4 * ((height - 1 - j) * width + i));
    }
    this.image.width = width;
    this.image.height = height;
    this.image.getContext("2d").putImageData(pixels, 0, 0);
  }

  // @param marked positions of the cells to frame. @param way positions of cells to join by a line, if there is
  // one; @param filled so many of its dots are, from the first on
  draw(marked, way = [], filled = 0) {
    const { plot, image } = this;
    plot.begin((width) => this.heightFor(width), kMargin);
    const { left, top, width, height } = plot.frame;
    plot.context.imageSmoothingEnabled = false;
    plot.context.drawImage(image, left, top, width, height);
    plot.acrossAxis(ticksOf(this.across, width / 80), this.across.title);
    plot.upAxis(this.up === null ? [] : ticksOf(this.up, height / 50), this.up === null ? "" : this.up.title);
    if (way.length > 0) this.drawWay(way.map((cell) => this.middleOf(cell)), filled);
    for (const cell of marked) this.mark(cell);
  }

  // Black in white, to be seen on every colour.
  drawWay(points, filled) {
    const { context } = this.plot;
    context.lineJoin = "round";
    for (const [width, color] of [[5, "#ffffff"], [2, "#000000"]]) {
      context.strokeStyle = color;
      context.lineWidth = width;
      context.beginPath();
      for (const [x, y] of points) context.lineTo(x, y);
      context.stroke();
    }
    context.strokeStyle = "#000000";
    for (const [place, [x, y]] of points.entries()) {
      context.fillStyle = place < filled ? "#000000" : "#ffffff";
      context.beginPath();
      context.arc(x, y, 4, 0, 2 * Math.PI);
      context.fill();
      context.stroke();
    }
    context.lineWidth = 1;
  }

  // In CSS pixels.
  middleOf([i, j]) {
    const { left, top, width, height } = this.plot.frame;
    return [left + ((i + 0.5) * width) / this.image.width, top + height - ((j + 0.5) * height) / this.image.height];
  }

  // In scale where both dimensions have one unit and that leaves a picture.
  heightFor(width) {
    if (this.up === null) return 48;
    const extent = (axis) => axis.points[axis.points.length - 1] - axis.points[0] + axis.step;
    const ratio = extent(this.up) / extent(this.across);
    const inScale = this.up.unit === this.across.unit && ratio > 0.25 && ratio < 2;
    return Math.min(width * (inScale ? ratio : 0.75), kMostHeight);
  }

  mark(cell) {
    const { width, height } = this.plot.frame;
    const [x, y] = this.middleOf(cell);
    const [halfWidth, halfHeight] = [width / this.image.width, height / this.image.height].map((size) => Math.max(size / 2, 3.5));
    const { context } = this.plot;
    for (const [grow, color] of [[2, "#ffffff"], [0.5, "#000000"]]) {
      context.strokeStyle = color;
      context.lineWidth = 1.5;
      context.strokeRect(x - halfWidth - grow, y - halfHeight - grow, 2 * (halfWidth + grow), 2 * (halfHeight + grow));
    }
    context.lineWidth = 1;
  }

  cellAt(event) {
    if (this.plot.frame === undefined) return null;
    const [x, y] = this.plot.placeOf(event);
    if (x < 0 || x >= 1 || y < 0 || y >= 1) return null;
    return [Math.floor(x * this.image.width), Math.floor(y * this.image.height)];
  }
}

// Ticks at round values; places count cells, which are equally wide in a picture.
function ticksOf(axis, most) {
  const { points } = axis;
  const last = points.length - 1;
  if (last < most) return points.map((value, i) => [(i + 0.5) / points.length, numberText(value)]);
  return ticksBetween(points[0], points[last], most).map((value) => {
    let low = 0;
    while (low < last - 1 && points[low + 1] <= value) ++low;
    const place = low + (value - points[low]) / (points[low + 1] - points[low]);
    return [(place + 0.5) / points.length, numberText(Number(value.toPrecision(12)))];
  });
}
