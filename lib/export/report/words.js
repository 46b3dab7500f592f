// Numbers and answers in words, the same as those of `coordreq query`.

// As C's %.6g.
function numberText(value) {
  if (value === 0) return "0";
  const [digits, exponent] = value.toExponential(5).split("e");
  if (exponent >= -4 && exponent < 6) return String(Number(value.toPrecision(6)));
  const size = String(Math.abs(exponent)).padStart(2, "0");
  return `${Number(digits)}e${exponent < 0 ? "-" : "+"}${size}`;
}

function grouped(count) {
  return String(count).replace(/\B(?=(\d{3})+$)/g, ",");
}

function stepsText(steps) {
  const count = `${grouped(steps)} step${steps === 1 ? "" : "s"}`;
  return data.unit === "" ? count : `${count} (${numberText(steps * data.period)} ${data.unit})`;
}

// Time first, for people who do not think in steps.
function timeText(steps) {
  const count = `${grouped(steps)} step${steps === 1 ? "" : "s"}`;
  return data.unit === "" ? count : `${numberText(steps * data.period)} ${data.unit} (${count})`;
}

function withUnit(text, unit) {
  return unit === "" ? text : `${text} ${unit}`;
}

function collisionText(steps) {
  if (steps === Infinity) return "never, with coordination";
  if (steps === 0) return "0 steps: not safe now";
  return `possibly within ${stepsText(steps)}, even with full coordination`;
}

// The delay of a cell in the last layer that was computed is a lower bound.
function delayText(delay, partition) {
  if (delay === -2) return "none: the cell is not safe";
  if (delay === -1) return "none: on this grid no coordination keeps the system safe from here";
  if (delay === Infinity) return "unbounded: safe without coordination indefinitely";
  const atLeast = partition.truncated && delay + 1 === partition.layers.length;
  return (atLeast ? "at least " : "") + stepsText(delay);
}

// What a trigger table says: after how many steps alone the agents must start to connect.
function countdownText(delay) {
  if (delay < 0) return "none";
  if (delay === Infinity) return "never need to connect";
  const steps = delay - data.connection_delay;
  if (steps < 0) return "a connection must exist already";
  if (steps > 0) return stepsText(steps);
  return data.connection_delay > 0 ? "start to connect now" : "coordinate now";
}

const kWholeShare = 10000; // freedom is stored in hundredths of a per cent

function freedomText(share) {
  if (share === kWholeShare) return "all";
  return `${share % 100 === 0 ? share / 100 : (share / 100).toFixed(share % 10 === 0 ? 1 : 2)} %`;
}

const kWholeLogarithm = 1201; // probabilities: 0, or 1 and hundredths of a power of ten above 1e-12, rounded up

function probabilityText(code) {
  if (code < 2) return code === 0 ? "0" : "at most 1e-12";
  const power = (code - 1) / 100 - 12;
  const unit = 10 ** (Math.floor(power) - 1);
  return `at most ${numberText(Math.min(1, Math.ceil(10 ** power / unit - 1e-9) * unit))}`;
}
