// What the reader has chosen, and the controls for it.

const find = (id) => document.getElementById(id);

function make(tag, properties = {}, children = []) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

const kKinds = { delay: "Delay (silence without risk)", collision_time: "Time to collision" };

// The two with the most grid points, in their order; null for the second if there is one only.
function longestDimensions() {
  const order = data.states.map((_, i) => i).sort((a, b) => data.states[b].points.length - data.states[a].points.length || a - b);
  return order.length < 2 ? [0, null] : order.slice(0, 2).sort((a, b) => a - b);
}

class Explorer {
  constructor() {
    this.kind = data.maps[0].kind;
    this.map = 0; // of those, the delay that is chosen
    [this.across, this.up] = longestDimensions();
    this.wanted = { kind: this.kind, map: this.map, across: this.across, up: this.up };
    this.hovered = null; // positions in the picture
    this.onChange = () => {};
    this.picture = new Picture(
      find("picture"),
      (cell) => this.hover(cell),
      (cell) => this.choose(cell),
    );
    this.addControls();
    this.index = data.states.map((state) => Math.floor(state.points.length / 2));
  }

  // Shows the middle of the grid, or a best state where there is nothing to see in the middle.
  async start() {
    await this.change({});
    const { best } = data.maps[0];
    if (best !== null && this.isUniform()) this.goTo(best);
    find("spoken").textContent = "";
  }

  isUniform() {
    const { data: pixels } = this.picture.image.getContext("2d").getImageData(0, 0, this.picture.image.width, this.picture.image.height);
    return pixels.every((value, i) => value === pixels[i % 4]);
  }

  addControls() {
    const kinds = [...new Set(data.maps.map((map) => map.kind))];
    for (const kind of kinds) {
      const radio = make("input", { type: "radio", name: "kind", value: kind, checked: kind === this.kind });
      radio.addEventListener("change", () => this.change({ kind }));
      find("kinds").append(make("label", {}, [radio, ` ${kKinds[kind]}`]));
    }
    data.maps.forEach((map, number) => {
      if (map.kind !== "delay") return;
      find("partition").append(make("option", { value: number, textContent: data.partitions[map.partition].name }));
    });
    find("partition-field").hidden = find("partition").length < 2;
    find("partition").addEventListener("change", (event) => this.change({ map: Number(event.target.value) }));
    for (const name of ["across", "up"]) this.addAxisControl(name);
    find("best").addEventListener("click", () => this.goTo(data.maps[this.map].best));
    find("picture").addEventListener("keydown", (event) => this.press(event));
  }

  addAxisControl(name) {
    const field = find(name);
    find("axes").hidden = data.states.length < 3;
    data.states.forEach((state, i) => field.append(make("option", { value: i, textContent: state.name })));
    field.addEventListener("change", () => {
      const other = name === "across" ? "up" : "across";
      const chosen = Number(field.value);
      // Two equal axes are no picture: the other one takes what this one was.
      const { wanted } = this;
      this.change({ [other]: chosen === wanted[other] ? wanted[name] : wanted[other], [name]: chosen });
    });
  }

  // Shows what is chosen, as soon as its values are unpacked and unless something else was chosen meanwhile.
  async change(choices) {
    const wanted = (this.wanted = { ...this.wanted, ...choices });
    const set = sets.find((candidate) => candidate.shows(wanted.across, wanted.up ?? wanted.across));
    await set.load();
    if (wanted !== this.wanted) return;
    Object.assign(this, wanted);
    this.set = set;
    this.hovered = null; // its place may be none in another cut
    this.index = this.index.map((k, i) => set.indices[i][set.nearest(i, k)]);
    this.addSliders();
    this.redraw();
    this.onChange();
  }

  // The map that is shown.
  shownMap() {
    return this.kind === "delay" ? this.map : data.maps.findIndex((map) => map.kind === this.kind);
  }

  partition() {
    return data.partitions[data.maps[this.map].partition];
  }

  addSliders() {
    find("across").value = this.across;
    find("up").value = this.up;
    find("sliders").replaceChildren();
    data.states.forEach((state, i) => {
      if (i !== this.across && i !== this.up) find("sliders").append(this.slider(state, i));
    });
    const thinned = data.states.filter((_, i) => !this.set.isWhole(i));
    find("thinned").textContent = thinned.length === 0 ? "" : thinnedText(thinned.map((state) => state.name));
  }

  slider(state, i) {
    const all = this.set.indices[i];
    const id = `slider-${i}`;
    const range = make("input", { type: "range", id, min: 0, max: all.length - 1, step: 1, disabled: all.length < 2 });
    range.value = this.set.nearest(i, this.index[i]);
    const reading = make("output");
    reading.setAttribute("for", id);
    const read = () => {
      reading.textContent = withUnit(numberText(state.points[this.index[i]]), state.unit);
      range.setAttribute("aria-valuetext", reading.textContent);
    };
    range.addEventListener("input", () => {
      this.index[i] = all[Number(range.value)];
      read();
      this.redraw();
    });
    read();
    return make("div", { className: "slider" }, [make("label", { htmlFor: id, textContent: state.name }), range, reading]);
  }

  positions(index = this.index) {
    return index.map((k, i) => this.set.nearest(i, k));
  }

  redraw() {
    const map = this.shownMap();
    const positions = this.positions();
    const coloring = coloringOf(data.maps[map]);
    this.picture.show(this.axis(this.across), this.up === null ? null : this.axis(this.up), (i, j) => {
      positions[this.across] = i;
      if (this.up !== null) positions[this.up] = j;
      return coloring.color(this.set.value(map, positions));
    });
    showLegend(coloring);
    const best = data.maps[this.map].best;
    find("best").hidden = best === null || best.some((k, i) => !this.set.indices[i].includes(k));
    this.mark();
  }

  axis(i) {
    const state = data.states[i];
    const points = this.set.indices[i].map((k) => state.points[k]);
    return { points, step: state.step, unit: state.unit, title: state.unit === "" ? state.name : `${state.name} [${state.unit}]` };
  }

  inPicture(index) {
    const positions = this.positions(index);
    return [positions[this.across], this.up === null ? 0 : positions[this.up]];
  }

  indexAt([i, j]) {
    const index = [...this.index];
    index[this.across] = this.set.indices[this.across][i];
    if (this.up !== null) index[this.up] = this.set.indices[this.up][j];
    return index;
  }

  // Draws the picture again, with its frames, and reads the values of the cell.
  mark() {
    const kept = this.inPicture(this.index);
    this.picture.draw(this.hovered === null ? [kept] : [kept, this.hovered]);
    const index = this.hovered === null ? this.index : this.indexAt(this.hovered);
    const rows = readings(index, this.positions(index), this.set, this.partition());
    find("cell").tBodies[0].replaceChildren(...rows.map(([name, text]) => rowOf(name, text)));
    const names = [this.across, this.up].filter((i) => i !== null).map((i) => data.states[i].name);
    find("picture").setAttribute("aria-label", `${kKinds[this.kind]} over ${names.join(" and ")}`);
    return rows;
  }

  hover(cell) {
    if (this.set === undefined || String(cell) === String(this.hovered)) return;
    this.hovered = cell;
    this.mark();
  }

  choose(cell) {
    this.index = this.indexAt(cell);
    this.mark();
  }

  goTo(index) {
    this.index = [...index];
    this.addSliders();
    this.redraw();
    this.speak();
  }

  press(event) {
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1], Home: [-Infinity, 0], End: [Infinity, 0] };
    if (!(event.key in steps) || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    const size = event.shiftKey ? 10 : 1;
    const cell = this.inPicture(this.index).map((place, axis) => {
      const i = axis === 0 ? this.across : this.up;
      const last = i === null ? 0 : this.set.indices[i].length - 1;
      const step = steps[event.key][axis];
      return Math.max(0, Math.min(last, step === 0 ? place : place + size * step));
    });
    this.hovered = null;
    this.choose(cell);
    this.speak();
  }

  // For those who do not see the table.
  speak() {
    find("spoken").textContent = readings(this.index, this.positions(), this.set, this.partition())
      .filter(([name]) => name !== "Cell")
      .map(([name, text]) => `${name}: ${text}`)
      .join("; ");
  }
}

function thinnedText(names) {
  return (
    `There are more cells than this page can hold: of ${names.join(", ")} it has some values only, all shown with the ` +
    "true numbers of their cells. The results file knows the others: coordreq query."
  );
}

function rowOf(name, text) {
  return make("tr", {}, [make("th", { scope: "row", textContent: name }), make("td", { textContent: text })]);
}

// Everything that is known of a cell, as pairs of a name and a text.
function readings(index, positions, set, partition) {
  const state = data.states.map(({ name, unit, points }, i) => `${name} = ${withUnit(numberText(points[index[i]]), unit)}`);
  const valueOf = (kind) => {
    const map = data.maps.findIndex((m) => m.kind === kind && (kind !== "delay" || data.partitions[m.partition] === partition));
    return set.value(map, positions);
  };
  const delay = valueOf("delay");
  return [
    ["Centre", state.join(", ")],
    ["Cell", `number ${grouped(cellNumber(index))}, index (${index.join(", ")})`],
    ["Safe set", delay === -2 ? "outside" : "inside"],
    ["Invariance set", delay < 0 ? "outside" : "inside"],
    ["Leaves the safe set", collisionText(valueOf("collision_time"))],
    ["Delay", delayText(delay, partition)],
    ["Countdown", countdownText(delay)],
  ];
}

const kMeanings = {
  delay: new Map([
    [-2, [kColors.notSafe, "not safe"]],
    [-1, [kColors.notInvariant, "cannot be kept safe, whatever is coordinated"]],
    [Infinity, [kColors.free, "safe without contact for ever"]],
  ]),
  collision_time: new Map([
    [0, [kColors.notSafe, "not safe"]],
    [Infinity, [kColors.free, "never leaves the safe set, with coordination"]],
  ]),
};

// How the values of a map are coloured, and what the colours mean. Steps go from `low` to `high`.
function coloringOf(map) {
  const meanings = kMeanings[map.kind];
  const low = meanings.has(0) ? Math.min(1, map.largest) : 0;
  const high = map.largest;
  const known = new Map([...meanings].map(([value, [color]]) => [value, color]));
  return {
    low,
    high,
    color: (value) => {
      if (!known.has(value)) known.set(value, scaleColor(high > low ? (value - low) / (high - low) : 0));
      return known.get(value);
    },
    legend: [...meanings]
      .filter(([value]) => map.flags.includes(value === Infinity ? "infinite" : value) || value === 0)
      .map(([, meaning]) => meaning),
  };
}

function showLegend(coloring) {
  find("scale").hidden = coloring.high === 0;
  find("scale-low").textContent = timeText(coloring.low);
  find("scale-high").textContent = timeText(coloring.high);
  const bar = find("scale-bar").getContext("2d");
  for (let i = 0; i < 256; ++i) {
    bar.fillStyle = cssColor(scaleColor(i / 255));
    bar.fillRect(i, 0, 1, 1);
  }
  find("legend").replaceChildren(
    ...coloring.legend.map(([color, text]) => {
      const swatch = make("span", { className: "swatch" });
      swatch.style.backgroundColor = cssColor(color);
      return make("li", {}, [swatch, text]);
    }),
  );
}

// Light or dark: what the system says until the button is pressed.
function addThemeButton(redraw) {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const root = document.documentElement;
  const isDark = () => (root.dataset.theme ?? (dark.matches ? "dark" : "light")) === "dark";
  const refresh = () => {
    find("theme").textContent = isDark() ? "Light" : "Dark";
    find("theme").setAttribute("aria-label", isDark() ? "Switch to light colours" : "Switch to dark colours");
    redraw();
  };
  find("theme").hidden = false;
  find("theme").addEventListener("click", () => {
    root.dataset.theme = isDark() ? "light" : "dark";
    refresh();
  });
  dark.addEventListener("change", refresh);
  refresh();
}

async function start() {
  if (!("DecompressionStream" in window)) {
    find("explore-missing").textContent = "The pictures need a newer browser.";
    return;
  }
  const explorer = new Explorer();
  find("explore").hidden = false;
  await explorer.start();
  find("explore-missing").hidden = true;
  const chart = new Chart(find("chart"), find("chart-reading"));
  const hasChart = data.partitions[0].layers[0] > 0;
  find("silence").hidden = !hasChart;
  explorer.onChange = () => hasChart && chart.show(explorer.partition());
  explorer.onChange();
  const redraw = () => {
    explorer.mark();
    if (hasChart) chart.draw();
  };
  addThemeButton(redraw);
  new ResizeObserver(redraw).observe(find("explore"));
  document.documentElement.dataset.ready = "yes";
}

start();
