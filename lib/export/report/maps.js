// The data of the page, as lib/export/report_data.hpp describes them.
const data = JSON.parse(document.getElementById("data").textContent);

const kFlags = 3; // a number v is stored as v + 3
const kTypes = { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array };

// The stored numbers of a map. Every browser that there is runs on little-endian machines.
async function unpack(packed) {
  const bytes = Uint8Array.from(atob(packed.data), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new kTypes[packed.bytes](await new Response(stream).arrayBuffer());
}

// Cells with their values: all combinations of some indices of each dimension.
class CellSet {
  constructor(stored) {
    this.stored = stored;
    this.indices = stored.indices;
    this.strides = [];
    let stride = 1;
    for (let i = this.indices.length - 1; i >= 0; --i) {
      this.strides[i] = stride;
      stride *= this.indices[i].length;
    }
  }

  // Unpacks the values, once.
  load() {
    this.loading ??= Promise.all(this.stored.maps.map(unpack)).then((codes) => {
      this.codes = codes;
      this.never = this.stored.maps.map((map) => 2 ** (8 * map.bytes) - 1);
    });
    return this.loading;
  }

  shows(x, y) {
    const pair = this.stored.shows;
    return pair === null || (pair.includes(x) && pair.includes(y));
  }

  isWhole(i) {
    return this.indices[i].length === data.states[i].points.length;
  }

  // Where the grid index nearest to k stands among those of dimension i.
  nearest(i, k) {
    const all = this.indices[i];
    let best = 0;
    for (let j = 1; j < all.length; ++j) {
      if (Math.abs(all[j] - k) < Math.abs(all[best] - k)) best = j;
    }
    return best;
  }

  // The value at positions among the indices: a number of steps, a flag or Infinity.
  value(map, positions) {
    let place = 0;
    for (let i = 0; i < positions.length; ++i) place += positions[i] * this.strides[i];
    return this.decode(map, this.codes[map][place]);
  }

  decode(map, code) {
    return code === this.never[map] ? Infinity : code - kFlags;
  }
}

const sets = data.sets.map((stored) => new CellSet(stored));

// The number of a cell in the whole grid, row-major.
function cellNumber(index) {
  return index.reduce((number, k, i) => number * data.states[i].points.length + k, 0);
}
