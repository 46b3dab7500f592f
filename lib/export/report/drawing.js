// Colours and axes.

// Viridis, by Stefan van der Walt and Nathaniel Smith (CC0): perceptually uniform, readable for colour-blind
// people and in grey. 32 of its colours; between them is interpolated.
const kScale = (
  "440154 470d60 48186a 482475 472e7c 453882 424186 3e4c8a 3a548c 365d8d 32658e " +
  "2e6d8e 2b758e 287d8e 25848e 228c8d 1f948c 1e9c89 20a386 25ab82 2eb37c 3aba76 " +
  "48c16e 58c765 69cd5b 7fd34e 93d741 a8db34 bddf26 d5e21a eae51a fde725"
).split(" ").map(rgbOf);

const kColors = {
  notSafe: [0x7f, 0x7f, 0x7f],
  notInvariant: [0xbd, 0xbd, 0xbd],
  free: [0xff, 0xff, 0xff],
};

function rgbOf(hex) {
  return [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16));
}

// The colour of a share from 0 to 1.
function scaleColor(share) {
  const place = share * (kScale.length - 1);
  const low = Math.min(Math.floor(place), kScale.length - 2);
  return kScale[low].map((from, i) => Math.round(from + (kScale[low + 1][i] - from) * (place - low)));
}

function cssColor([red, green, blue]) {
  return `rgb(${red}, ${green}, ${blue})`;
}

function themeColor(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

// Round numbers from low to high, about `most` of them.
function ticksBetween(low, high, most) {
  if (!(high > low)) return [low];
  const rough = (high - low) / Math.max(most, 1);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((size) => size >= rough * 0.999);
  const ticks = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + step * 1e-9; ++n) ticks.push(n * step);
  return ticks;
}

// A canvas as wide as its place on the page, with room for axes around a frame. Sizes are CSS pixels.
class Plot {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
  }

  // Clears it and lays out a frame of the height that `heightOf(width of the frame)` says.
  begin(heightOf, margin) {
    const width = Math.max(this.canvas.clientWidth, 120);
    const frameWidth = width - margin.left - margin.right;
    const frameHeight = Math.round(heightOf(frameWidth));
    const height = frameHeight + margin.top + margin.bottom;
    const ratio = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.canvas.style.height = `${height}px`;
    this.frame = { left: margin.left, top: margin.top, width: frameWidth, height: frameHeight };
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, width, height);
    this.context.font = `13px ${getComputedStyle(document.body).fontFamily}`;
  }

  // @param ticks [[place from 0 to 1, text], ...]
  acrossAxis(ticks, title) {
    const { left, top, width, height } = this.frame;
    this.axisStyle("center", "top");
    for (const [place, text] of ticks) {
      const x = left + place * width;
      this.context.fillRect(x - 0.5, top + height, 1, 5);
      this.context.fillText(text, x, top + height + 8);
    }
    this.context.fillText(title, left + width / 2, top + height + 27);
  }

  upAxis(ticks, title) {
    const { left, top, width, height } = this.frame;
    this.axisStyle("right", "middle");
    for (const [place, text] of ticks) {
      const y = top + (1 - place) * height;
      this.context.fillRect(left - 5, y - 0.5, 5, 1);
      this.context.fillText(text, left - 8, y);
    }
    this.context.save();
    this.context.translate(12, top + height / 2);
    this.context.rotate(-Math.PI / 2);
    this.context.textAlign = "center";
    this.context.fillText(title, 0, 0);
    this.context.restore();
    this.context.strokeStyle = themeColor("--line");
    this.context.strokeRect(left - 0.5, top - 0.5, width + 1, height + 1);
  }

  axisStyle(align, baseline) {
    this.context.fillStyle = themeColor("--muted");
    this.context.textAlign = align;
    this.context.textBaseline = baseline;
  }

  // Where an event is, as shares of the frame from its lower left corner; may lie outside of 0 to 1.
  placeOf(event) {
    const box = this.canvas.getBoundingClientRect();
    const { left, top, width, height } = this.frame;
    return [(event.clientX - box.left - left) / width, 1 - (event.clientY - box.top - top) / height];
  }
}
