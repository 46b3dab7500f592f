// What the reader has chosen, and the controls for it.

const find = (id) => document.getElementById(id);

function make(tag, properties = {}, children = []) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

// The two with the most grid points, in their order; null for the second if there is one only.
function longestDimensions() {
  const order = data.states.map((_, i) => i).sort((a, b) => data.states[b].points.length - data.states[a].points.length || a - b);
  return order.length < 2 ? [0, null] : order.slice(0, 2).sort((a, b) => a - b);
}

// The first delay of the partition with the most classes: there silence matters most.
function mostClasses() {
  const classes = data.maps.map((map) => (map.kind === "delay" ? data.partitions[map.partition].classes : 0));
  return classes.indexOf(Math.max(...classes));
}

class Explorer {
  constructor() {
    this.kind = data.maps[0].kind;
    this.map = mostClasses(); // of those, the delay that is chosen
    [this.across, this.up] = longestDimensions();
    this.members = { pairs: 0, modes: 0, freedom: 0 }; // those that are chosen
    this.way = null; // number of the counterexample that is drawn
    this.wanted = { kind: this.kind, map: this.map, members: this.members, way: null, across: this.across, up: this.up };
    this.hovered = null; // positions in the picture
    this.onChange = () => {};
    this.picture = new Picture(
      find("picture"),
      (cell) => this.hover(cell),
      (cell) => this.choose(cell),
    );
    this.addControls();
    this.index = data.states.map((state) => (state.kept ? 0 : Math.floor(state.points.length / 2)));
  }

  // Shows the worst state of the first requirement that fails, else a best state.
  async start() {
    await this.change({});
    if (data.ways.length > 0) await this.showWay(0, 0);
    else {
      const best = data.maps[this.map].best ?? data.latest;
      if (best !== null) this.goTo(best);
    }
    find("spoken").textContent = "";
  }

  addControls() {
    const kinds = [...new Set(data.maps.map((map) => map.kind))];
    for (const kind of kinds) {
      const radio = make("input", { type: "radio", name: "kind", value: kind, checked: kind === this.kind });
      radio.addEventListener("change", () => this.change({ kind }));
      find("kinds").append(make("label", {}, [radio, ` ${kindTitle(kind)}`]));
    }
    data.maps.forEach((map, number) => {
      if (map.kind !== "delay") return;
      find("partition").append(make("option", { value: number, textContent: data.partitions[map.partition].name }));
    });
    find("partition-field").hidden = find("partition").length < 2;
    find("partition").addEventListener("change", (event) => this.change({ map: Number(event.target.value) }));
    find("member").addEventListener("change", (event) => {
      this.change({ members: { ...this.wanted.members, [this.wanted.kind]: Number(event.target.value) } });
    });
    for (const name of ["across", "up"]) this.addAxisControl(name);
    for (const button of document.querySelectorAll("button.visit")) {
      button.addEventListener("click", () => this.visit(Number(button.dataset.way), Number(button.dataset.sample)));
    }
    find("hide-way").addEventListener("click", () => {
      this.change({ way: null });
      find("picture").focus();
    });
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
    this.showChoices();
    this.addSliders();
    this.redraw();
    this.onChange();
  }

  // The map that is shown.
  shownMap() {
    if (this.kind === "delay") return this.map;
    const ofPartition = data.maps.findIndex((map) => map.kind === this.kind && map.partition === data.maps[this.map].partition);
    if (ofPartition >= 0) return ofPartition;
    const first = data.maps.findIndex((map) => map.kind === this.kind);
    return this.kind === "freedom" || isLogarithm(data.maps[first]) ? first + (this.members[this.kind] ?? 0) : first;
  }

  // The controls say what is chosen, by whatever way it was.
  showChoices() {
    for (const radio of find("kinds").querySelectorAll("input")) radio.checked = radio.value === this.kind;
    find("partition").value = this.map;
    const names = memberNames(this.kind);
    find("member-field").hidden = names.length < 2;
    find("member-label").textContent = names.length < 2 ? "" : `${memberLabel(this.kind)} `;
    find("member").replaceChildren(...names.map((name, value) => make("option", { value, textContent: name })));
    if (names.length > 0) find("member").value = this.members[this.kind] ?? 0;
    for (const button of document.querySelectorAll("button.visit")) {
      button.hidden = false;
      button.disabled = !this.holds(data.ways[button.dataset.way].cells[button.dataset.sample]);
    }
    find("way").hidden = this.way === null;
    if (this.way !== null) find("way-text").textContent = wayText(data.ways[this.way]);
  }

  // Whether the page has the cell, in the cuts that are chosen.
  holds(index) {
    return index.every((k, i) => this.set.indices[i].includes(k));
  }

  // Goes to a cell that a counterexample visits.
  async visit(way, sample) {
    await this.showWay(way, sample);
    find("picture").scrollIntoView({ block: "center" });
    find("picture").focus({ preventScroll: true });
  }

  async showWay(way, sample) {
    const { partition, cells, kind } = data.ways[way];
    const map = data.maps.findIndex((other) => other.kind === "delay" && other.partition === partition);
    const members = { ...this.wanted.members, [kind]: 0 }; // of a network the mode in which it begins
    await this.change({ way, kind, members, ...(map >= 0 ? { map } : {}) });
    this.goTo(cells[sample]);
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
    const coloring = coloringOf(data.maps[map], this.members[this.kind]);
    this.picture.show(this.axis(this.across), this.up === null ? null : this.axis(this.up), (i, j) => {
      positions[this.across] = i;
      if (this.up !== null) positions[this.up] = j;
      return coloring.color(this.set.value(map, positions));
    });
    showLegend(coloring);
    const best = data.maps[this.map].best;
    find("best").hidden = best === null || !this.holds(best);
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
    const way = this.way === null ? null : data.ways[this.way];
    this.picture.draw(this.hovered === null ? [kept] : [kept, this.hovered], way?.cells.map((cell) => this.inPicture(cell)), way?.independent);
    const rows = this.readings(this.hovered === null ? this.index : this.indexAt(this.hovered));
    find("cell").tBodies[0].replaceChildren(...rows.map(([name, text]) => rowOf(name, text)));
    const names = [this.across, this.up].filter((i) => i !== null).map((i) => data.states[i].name);
    find("picture").setAttribute("aria-label", `${kindTitle(this.kind)} over ${names.join(" and ")}`);
    return rows;
  }

  readings(index) {
    return readings({ index, positions: this.positions(index), set: this.set, partition: this.partition() });
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
    find("spoken").textContent = this.readings(this.index)
      .filter(([name]) => name !== "Cell")
      .map(([name, text]) => `${name}: ${text}`)
      .join("; ");
  }
}

function thinnedText(names) {
  return (
    `There are more cells than this page can hold: of ${names.join(", ")} it has only some values, all shown with the ` +
    "true numbers of their cells. The results file has the others: coordreq query."
  );
}

// What can be chosen of a kind of map: pairs, modes, agents.
function memberNames(kind) {
  const maps = data.maps.filter((map) => map.kind === kind);
  if (isLogarithm(maps[0])) return maps[0].entry === null ? [] : maps.map((map) => map.entry);
  return kind === "freedom" ? maps.map((map) => map.agent) : (maps[0].members ?? []);
}

function memberLabel(kind) {
  const axis = data.maps.find((map) => map.kind === kind).axis ?? "";
  return kMembers[kind]?.label ?? axis.charAt(0).toUpperCase() + axis.slice(1);
}

function wayText({ requirement, independent, cells }) {
  const alone = independent > 0 ? "filled dots during independent choice, " : "";
  return `Counterexample of “${requirement}”, ${grouped(cells.length)} ${cells.length === 1 ? "state" : "states"} drawn over these two axes: ${alone}hollow dots when it is too late.`;
}

function rowOf(name, text) {
  return make("tr", {}, [make("th", { scope: "row", textContent: name }), make("td", { textContent: text })]);
}

function showLegend(coloring) {
  find("scale").hidden = coloring.high === 0;
  find("scale-low").textContent = coloring.high === 0 ? "" : coloring.label(coloring.low);
  find("scale-high").textContent = coloring.high === 0 ? "" : coloring.label(coloring.high);
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
