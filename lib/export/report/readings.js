// Everything that is known of a cell, in words.

// @param cell {index, positions, set, partition}
// @returns pairs of a name and a text, always the same names
function readings(cell) {
  const { index, partition } = cell;
  const state = data.states.map(({ name, unit, points }, i) => `${name} = ${withUnit(numberText(points[index[i]]), unit)}`);
  const delay = valueAt(cell, (map) => map.kind === "delay" && data.partitions[map.partition] === partition);
  return [
    ["Centre", state.join(", ")],
    ["Cell", `number ${grouped(cellNumber(index))}, index (${index.join(", ")})`],
    ["Safe set", delay === -2 ? "outside" : "inside"],
    ["Invariance set", delay < 0 ? "outside" : "inside"],
    ["Leaves the safe set", collisionText(valueAt(cell, (map) => map.kind === "collision_time"))],
    ["Delay", delayText(delay, partition)],
    ["Connect in", countdownText(delay)],
    ...data.maps.filter((map) => map.partition === undefined || data.partitions[map.partition] === partition).flatMap((map) => furtherReading(map, cell)),
  ];
}

function valueAt({ set, positions }, isWanted) {
  return set.value(data.maps.findIndex(isWanted), positions);
}

// What is not known of every file.
function furtherReading(map, cell) {
  const value = valueAt(cell, (other) => other === map);
  switch (map.kind) {
    case "coalition":
      return [["Cheapest partition", partitionText(value)]];
    case "pairs":
      // Where no partition suffices no pair is the one that is missing.
      return [["Critical pairs", valueAt(cell, (other) => other.kind === "coalition") < 0 ? "-" : pairsText(map, value)]];
    case "modes":
      return [["Safe in", modesText(map, value)]];
    case "freedom":
      return [[`Convention: actions of ${map.agent}`, value < 0 ? "-" : freedomText(value)]];
    case "delay":
    case "collision_time":
      return [];
    default:
      if (isLogarithm(map)) return [[map.title + (map.entry === null ? "" : `, ${map.entry}`), value < 0 ? "-" : probabilityText(value)]];
      return [[map.title, meaningsOf(map).get(value)?.[1] ?? timeText(value)]];
  }
}

function partitionText(value) {
  if (value === -3) return "none: no partition of the file suffices";
  return value < 0 ? "none" : data.partitions[value].name;
}

// @param set hexadecimal digits
function hasMember(set, member) {
  const place = set.length - 1 - (member >> 2);
  return place >= 0 && ((parseInt(set[place], 16) >> (member & 3)) & 1) === 1;
}

function membersOf(map, value) {
  return value < 0 ? [] : map.members.filter((_, member) => hasMember(map.sets[value], member));
}

function pairsText(map, value) {
  const names = membersOf(map, value);
  const whole = map.members.length === map.total ? "" : ` (of the first ${grouped(map.members.length)} pairs)`;
  return (names.length === 0 ? "none" : names.join(", ")) + whole;
}

function modesText(map, value) {
  const kMostListed = 12;
  const names = membersOf(map, value);
  const shown = map.members.length;
  const whole = shown === map.total ? "" : ` of the first ${grouped(shown)} modes`;
  if (names.length === 0) return "no mode" + whole;
  if (names.length === shown) return whole === "" ? `all ${grouped(shown)} modes` : `all${whole}`;
  const listed = names.slice(0, kMostListed).join(", ") + (names.length > kMostListed ? " ..." : "");
  return `${grouped(names.length)} of ${whole === "" ? `${grouped(shown)} modes` : whole.slice(4)}: ${listed}`;
}
