// The page of a detection: what is said of what was found, and in which colours. Lengths of the detection are in mm.

const CONTENTS = {
  clear: { words: "clear liquid", colour: "#0072B2" }, opaque: { words: "opaque liquid", colour: "#D55E00" },
  some: { words: "liquid, clear or opaque", colour: "#B5478F" }, empty: { words: "empty", colour: "#00855F" },
  unknown: { words: "content not known", colour: "#9A7400" } };
const CLASSES = { desk: { words: "desk", colour: "#c3c9d0" }, candidate: { words: "no cup", colour: "#9c8378" }, other: { words: "anything else", colour: "#8f99a5" } };

function contentOf(cup) {
  if (cup.liquid === "no") return CONTENTS.empty;
  if (cup.liquid === "unknown") return CONTENTS.unknown;
  return cup.kind === "transparent" ? CONTENTS.clear : cup.kind === "opaque" ? CONTENTS.opaque : CONTENTS.some;
}

const oneDecimal = number => number.toFixed(1);
// "27 ± 6 mm"; nothing where it was not seen.
const withSigma = (value, sigma, digits = 1) =>
  value === null ? "" : `${value.toFixed(digits)}${sigma === null || sigma === undefined ? "" : ` ± ${sigma.toFixed(digits)}`} mm`;
const depthOf = cup => withSigma(cup.fill_mm, cup.fill_sigma_mm, 0);
const shortName = (cup, number) => `cup ${number}: ${contentOf(cup).words}${cup.fill_mm === null ? "" : `, ${depthOf(cup)}`}`;

const leanOf = cup => cup.lean_deg === null ? 0 : Math.tan(cup.lean_deg * Math.PI / 180);
// [m] Of the wall that was found, at a height [m]; the radius is that 45 mm above the desk.
const radiusAt = (cup, height) => Math.max(cup.radius_mm / MM + leanOf(cup) * (height - 0.045), 0.002);
// [m] Where the liquid's surface is thought to be: nothing where that is not known.
const surfaceOf = cup => cup.fill_mm === null || cup.bottom_mm === null ? null : (cup.bottom_mm + cup.fill_mm) / MM;

// Everything that was found, in the order of the points' owners, which begin at 2.
function thingsOf(data) {
  return [...data.cups.map((cup, number) => ({ cup, number, at: new THREE.Vector3(cup.at_m[0], cup.at_m[1], 0), colour: contentOf(cup).colour, radius: cup.radius_mm / MM, height: cup.height_mm / MM })),
          ...data.candidates.map((candidate, number) => ({ candidate, number, at: new THREE.Vector3(candidate.at_m[0], candidate.at_m[1], 0), colour: CLASSES.candidate.colour, radius: candidate.width_mm / 2 / MM, height: Math.max(candidate.height_mm / MM, 0.005) }))];
}
