// How the values of each kind of map are coloured, and what the colours mean.

const kKinds = {
  delay: "Delay (silence without risk)",
  collision_time: "Time to collision",
  coalition: "Cheapest partition",
  pairs: "Critical pairs",
  modes: "Safe on the network",
  freedom: "Freedom under the convention",
};

// Okabe and Ito's palette, which colour-blind people can tell apart.
const kPalette = ["0072b2", "e69f00", "009e73", "d55e00", "cc79a7", "56b4e9", "f0e442"].map(rgbOf);
const kMostNamed = 16; // partitions that have colours of their own

const kLost = [
  [-2, [kColors.notSafe, "not safe"]],
  [-1, [kColors.notInvariant, "cannot be kept safe on this grid, even with full coordination"]],
];
const kMeanings = {
  delay: new Map([...kLost, [Infinity, [kColors.free, "safe without contact indefinitely"]]]),
  collision_time: new Map([
    [0, [kColors.notSafe, "not safe"]],
    [Infinity, [kColors.free, "never leaves the safe set, with coordination"]],
  ]),
  freedom: new Map(kLost),
};
const kMembers = {
  pairs: { label: "Pair", yes: [rgbOf("d55e00"), "critical: every cheapest network that suffices connects the two"], no: [kColors.free, "not critical"] },
  modes: {
    label: "Mode",
    yes: [rgbOf("0072b2"), "safe in this mode, whatever the network does"],
    no: [rgbOf("e69f00"), "can be kept safe, but not on this network from this mode"],
  },
  freedom: { label: "Agent" },
};

// What a kind of map is called; other kinds than these bring their name and the meanings of their values along.
function kindTitle(kind) {
  return kKinds[kind] ?? data.maps.find((map) => map.kind === kind).title;
}

// Of a probability.
function isLogarithm(map) {
  return map.scale === "logarithm";
}

function meaningsOf(map) {
  if (map.kind in kMeanings) return kMeanings[map.kind];
  if (isLogarithm(map)) return new Map([...kLost, [0, [kColors.free, "0"]]]);
  return new Map(
    map.meanings.map(([value, word]) => {
      if (value === "infinite") return [Infinity, [kColors.free, word]];
      return [value, [value === -1 ? kColors.notInvariant : value < 0 ? kColors.notSafe : scaleColor(0), word]];
    }),
  );
}

// @param member place of the pair or mode that is shown, of maps that have some
// @returns color: of a value; legend: pairs of colours and texts; from `low` to `high` there is a scale with
//   labels, none if `high` is 0
function coloringOf(map, member) {
  if (map.kind === "coalition") return colorsOfPartitions(map);
  if (map.kind in kMembers && map.members !== undefined) return colorsOfMember(map, member);
  return colorsOfSteps(map);
}

function colorsOfSteps(map) {
  const meanings = meaningsOf(map);
  const [label, high] = isLogarithm(map) ? [probabilityText, kWholeLogarithm] : map.kind === "freedom" ? [freedomText, kWholeShare] : [timeText, map.largest];
  const low = meanings.has(0) ? Math.min(1, map.largest) : 0;
  const known = colorsKnown(meanings);
  return {
    low,
    high,
    label,
    color: (value) => {
      if (!known.has(value)) known.set(value, scaleColor(high > low ? (value - low) / (high - low) : 0));
      return known.get(value);
    },
    legend: legendOf(map, meanings),
  };
}

function colorsOfPartitions(map) {
  const named = map.choices.slice(0, kMostNamed);
  const meanings = new Map([...kLost, [-3, [[0, 0, 0], "no partition of the file suffices"]]]);
  const known = colorsKnown(meanings);
  const own = named.map(({ partition, cost }, i) => {
    let color = scaleColor(i / Math.max(named.length - 1, 1));
    if (named.length <= kPalette.length) color = kPalette[i];
    if (data.partitions.length <= kPalette.length) color = kPalette[partition]; // the same in all pictures of the file
    known.set(partition, color);
    return [color, `${data.partitions[partition].name} (cost ${numberText(cost)})`];
  });
  const others = map.choices.length - named.length;
  if (others > 0) own.push([kColors.free, `${grouped(others)} other partitions`]);
  return { low: 0, high: 0, color: (value) => known.get(value) ?? kColors.free, legend: [...own, ...legendOf(map, meanings)] };
}

function colorsOfMember(map, member) {
  const { yes, no } = kMembers[map.kind];
  const known = colorsKnown(new Map(kLost));
  map.sets.forEach((set, value) => known.set(value, hasMember(set, member) ? yes[0] : no[0]));
  return { low: 0, high: 0, color: (value) => known.get(value), legend: [yes, no, ...legendOf(map, new Map(kLost))] };
}

function colorsKnown(meanings) {
  return new Map([...meanings].map(([value, [color]]) => [value, color]));
}

function legendOf(map, meanings) {
  return [...meanings]
    .filter(([value]) => map.flags.includes(value === Infinity ? "infinite" : value) || value === 0)
    .map(([, meaning]) => meaning);
}
