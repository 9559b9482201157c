// Numbers as people read them: at most four significant digits, kN and MN, mm.

/** Prefixes of a unit, largest first: factor and name. */
const kUnits = {
  "N": [[1e6, "MN"], [1e3, "kN"], [1, "N"]],
  "N m": [[1e6, "MN m"], [1e3, "kN m"], [1, "N m"]],
  "N/m": [[1e6, "MN/m"], [1e3, "kN/m"], [1, "N/m"]],
  "m": [[1, "m"], [1e-3, "mm"]],
  "m2": [[1, "m²"]],
  "share": [[0.01, "%"]],
  "Pa": [[1e6, "MPa"], [1e3, "kPa"], [1, "Pa"]],
};

/** Factor and name of the unit in which a number of this size is shown. */
function unitFor(size, unit) {
  const choices = kUnits[unit];
  if (!choices) return [1, unit];
  return choices.find(([factor]) => size >= factor) || choices[choices.length - 1];
}

function digits(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e7 || size < 1e-4) return value.toExponential(2);
  return size >= 1000 ? value.toFixed(0) : String(Number(value.toPrecision(4)));
}

/** "1.234 MN"; a dash for what is undefined. */
function shown(value, unit) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "–" : value > 0 ? "∞" : "-∞";
  const [factor, name] = unitFor(Math.abs(value), unit);
  return digits(value / factor) + (name ? " " + name : "");
}

// Colours. Sequential: dark to light blue-green-yellow (readable in greyscale and by the colour-blind). Diverging: blue for
// compression, red for tension.
const kSequential = [[253, 231, 167], [246, 178, 107], [222, 110, 94], [160, 52, 104], [70, 18, 92]];
const kDiverging = [[178, 24, 43], [244, 165, 130], [245, 245, 245], [146, 197, 222], [33, 102, 172]];
const kTension = [[0, 90, 200], [130, 40, 160], [225, 0, 40]];  // of thin bars, visible from the lowest on
const kUndefined = [150, 150, 150];
const kRoles = [[222, 205, 178], [196, 160, 116], [214, 106, 40], [128, 134, 140], [188, 198, 178]];
const kBodies = [[128, 134, 140], [230, 159, 0], [86, 180, 233], [0, 158, 115], [204, 121, 167], [0, 114, 178],
                 [213, 94, 0], [240, 228, 66]];

function between(stops, t) {
  const x = Math.min(Math.max(t, 0), 1) * (stops.length - 1);
  const i = Math.min(Math.floor(x), stops.length - 2), f = x - i;
  return [0, 1, 2].map((k) => stops[i][k] * (1 - f) + stops[i + 1][k] * f);
}

/** The colour scale of a column: stops and limits. Values of both signs get a symmetric diverging scale. Shares are
 * shown from 0 to 1. The highest and lowest hundredth of the values do not stretch the scale. */
function scaleOf(values, key) {
  const sorted = Float64Array.from(values.filter((v) => Number.isFinite(v))).sort();
  if (sorted.length === 0) return {stops: kSequential, low: 0, high: 1, cutLow: false, cutHigh: false};
  const least = sorted[0], most = sorted[sorted.length - 1];
  const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
  let low = at(0.01), high = at(0.99);
  const rounding = 1e-6 * Math.max(Math.abs(least), Math.abs(most));  // is neither of one sign nor of the other
  if (Math.abs(low) <= rounding) low = 0;
  if (Math.abs(high) <= rounding) high = 0;
  const fixed = {friction_use: 1, open_share: 1, strength_use: 1, damage: 1, relative_range: 2}[key];
  if (fixed) return {stops: kSequential, low: 0, high: fixed, cutLow: false, cutHigh: most > fixed};
  const signed = low < 0 && high > 0;
  if (signed) high = Math.max(-low, high), low = -high;
  else if (low >= 0) low = 0;
  if (high <= low) high = most > low ? most : low + 1;
  return {stops: signed ? kDiverging : kSequential, low, high, cutLow: least < low, cutHigh: most > high};
}

function colourAt(scale, value) {
  if (!Number.isFinite(value)) return kUndefined;
  return between(scale.stops, (value - scale.low) / (scale.high - scale.low));
}
