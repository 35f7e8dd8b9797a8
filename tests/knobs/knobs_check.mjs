// The part of a page that follows its knobs (page/model.js), without a browser:
//   node knobs_check.mjs MODEL.js QUESTIONS.json
// QUESTIONS.json: {"knobs": as the page holds them, "places": [[...]], "as_stated": false}. Prints for each place the curves of all runs, mm,
// and chi2 of each run.
import { readFileSync } from "node:fs";
import vm from "node:vm";

const [model, questions] = process.argv.slice(2);
vm.runInThisContext(readFileSync(model, "utf8"));
const { knobs, places, as_stated } = JSON.parse(readFileSync(questions, "utf8"));
const unpacked = (packed) => { let last = 0; return packed.d.map((step) => (step === null ? null : (last += step) * packed.q)); };
for (const run of knobs.runs)
  for (const curve of run.curves) {
    for (const name of ["time", "measured", "spread", "best", "given"]) curve[name] = unpacked(curve[name]);
    curve.columns = curve.columns.map(unpacked);
  }
const answers = places.map((place) => {
  const runs = knobs.kind === "swing" ? knob_model.swing_at(knobs, place, as_stated) : knob_model.response_at(knobs, place);
  return { runs: runs.map((run) => ({ curves: run.curves.map((curve) => [...curve]), chi2: run.chi2 })), error: knob_model.error_of(knobs, runs, "box", knobs.kind !== "swing") };
});
console.log(JSON.stringify(answers));
