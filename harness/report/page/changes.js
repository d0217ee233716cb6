"use strict";
// What changed since earlier records (`--against`): verdicts, endings, statuses and times.

const BEFORE = DATA.before ? {tables: tablesOf(DATA.before), claims: claimsOf(DATA.before), gates: gatesOf(DATA.before)} : null;
// Two runs of one program differ by some per cent though nothing has changed, so that less is no change.
const RUNS_DIFFER = 0.1;

const keyOf = (table, device) => (arrayOf(objectOf(table.document.passport).devices).find(d => d.name === device) || {}).key;

// The earlier verdict on the same device: of several machines that of the same one.
function judgedThen(before, verdict) {
  const then = before.verdicts.filter(v => v.device === verdict.device), same = then.find(v => v.key === verdict.key);
  return same || (then.length === 1 && !SEVERAL ? then[0] : null);
}
// Verdicts that are others now: claim, device, then, now.
function changedVerdicts() {
  return CLAIMS.flatMap(claim => {
    const before = BEFORE.claims.find(c => c.id === claim.id);
    return before ? claim.verdicts.map(v => [claim, v.on, judgedThen(before, v), v]).filter(([, , then, now]) => then && then.verdict !== now.verdict) : [];
  });
}
function changedEndings() {
  const now = GATES[GATES.length - 1], then = BEFORE.gates[BEFORE.gates.length - 1];
  if (!now || !then) return [];
  return now.cases.map(c => [c, then.named.get(c.name)]).filter(([c, k]) => !k || k.ending !== c.ending);
}
// The same in three: those to be read one by one, new ones that pass, and former ones that are gone.
function casesThatChanged() {
  const now = GATES[GATES.length - 1], then = BEFORE.gates[BEFORE.gates.length - 1], endings = changedEndings(), isNew = ([c, k]) => !k && endingClass(c.ending) === "good";
  return {endings: endings.filter(change => !isNew(change)), passing: endings.filter(isNew), gone: now && then ? then.cases.filter(k => !now.named.has(k.name)) : []};
}

// Cells of both runs. A time changed if it did by more than runs differ, and the intervals of both lie apart; times of
// another machine or driver (another comparison key) are not held against each other.
const changedCells = (() => {
  let found = null;
  return () => found || (found = TABLES.flatMap(table => {
    const then = BEFORE.tables.filter(t => t.name === table.name), before = then.find(t => t.key === table.key) || (then.length === 1 && !SEVERAL ? then[0] : null);
    return before ? cellsOfBoth(table, before) : [];
  }));
})();
function cellsOfBoth(table, before) {
  const nameOf = c => [c.row_number, c.device, c.variant, c.work].join("\n"), then = new Map(before.cells.map(c => [nameOf(c), c]));
  return table.cells.filter(c => then.has(nameOf(c))).map(cell => {
    const old = then.get(nameOf(cell)), a = rateOf(old), b = rateOf(cell), isComparable = keyOf(table, cell.device) && keyOf(table, cell.device) === keyOf(before, cell.device) && old.set === cell.set;
    const ratio = a && b ? {value: a.value / b.value, low: a.low / b.high, high: a.high / b.low} : null;
    const isApart = ratio && isComparable && a.low && b.low && (ratio.low > 1 || ratio.high < 1) && Math.abs(Math.log(ratio.value)) > Math.log(1 + RUNS_DIFFER);
    return {table, cell, old, ratio, isComparable, change: old.status !== cell.status ? "status" : isApart ? ratio.value > 1 ? "slower" : "faster" : null};
  });
}
const cellName = ({table, cell}) => [link("table", {id: table.id, variant: cell.variant, work: cell.work}, table.id), " ", rowText(objectOf(cell.row), keysOf(table)), cell.variant !== "full" ? `, ${words(cell.variant)}` : "", cell.work ? `, ${cell.work}` : ""];

// Records that are compared, and the commits of raingauge that wrote them: of several gates the last.
function comparedText(source) {
  const gate = records("gate", source).pop(), used = arrayOf(source.records).filter(r => ["table", "claims"].includes(r.kind) || r === gate), few = (texts, all) => texts.length > 3 ? all : list(texts);
  const files = [...new Set(used.map(r => fileText(r.file)))], folders = [...new Set(files.map(file => file.slice(0, file.lastIndexOf("/") + 1) || "the current folder"))];
  const commits = [...new Set(used.map(r => objectOf(passportOf(objectOf(r.document)).raingauge).commit).filter(commit => commit && typeof commit === "string").map(commit => commit.replace(/^([0-9a-f]{12})[0-9a-f]+/, "$1")))];
  return [few(files, `${files.length} files of ${few(folders, plural(folders.length, "folder"))}`), commits.length ? `by raingauge of ${commits.length > 1 ? "commits" : "commit"} ${few(commits, `${commits[0]} and ${commits.length - 1} others`)}` : ""].filter(Boolean).join(", ") || "nothing that is compared";
}
// The gates that are compared, and which other run the gate's own views compare with.
function gatesText() {
  const now = GATES[GATES.length - 1], then = BEFORE.gates[BEFORE.gates.length - 1], earlier = earlierOf(now);
  return `${fileText(now.file)} is compared with ${fileText(then.file)}.${earlier === then ? "" : ` The views of the gate compare it with ${fileText(earlier.file)}, the run before.`}`;
}

function changedText() {
  const cells = changedCells(), count = change => cells.filter(c => c.change === change).length, {endings, passing, gone} = casesThatChanged();
  const told = [[changedVerdicts().length, "verdict"], [endings.length, "case by its ending", "cases by their ending"], [passing.length, "new case that passes", "new cases that pass"], [gone.length, "case that is gone", "cases that are gone"], [count("status"), "cell of tables by its status", "cells of tables by their status"], [count("slower"), "cell that is slower", "cells that are slower"], [count("faster"), "cell that is faster", "cells that are faster"]]
    .filter(([n]) => n).map(([n, one, many]) => plural(n, one, many));
  return told.length ? `Changed since the earlier records: ${list(told)}.` : "Nothing changed since the earlier records.";
}

function viewChanges() {
  const cells = changedCells(), slower = cells.filter(c => c.change === "slower"), far = c => Math.abs(Math.log(c.ratio.value)), timed = [...slower.sort((a, b) => far(b) - far(a)), ...cells.filter(c => c.change === "faster").sort((a, b) => far(b) - far(a))];
  const verdicts = changedVerdicts(), {endings, passing, gone} = casesThatChanged(), others = cells.filter(c => c.change === "status"), foreign = cells.filter(c => c.ratio && !c.isComparable).length;
  const times = part("Times", el("p", {}, `${timed.length} of ${plural(cells.filter(c => c.ratio && c.isComparable).length, "cell")} changed: by more than ${100 * RUNS_DIFFER} %, which two runs may differ by, with intervals that lie apart.`,
    foreign ? ` ${plural(foreign, "cell")} of another machine, driver or setting ${foreign === 1 ? "is" : "are"} not held against each other.` : ""),
    timed.length ? sheet("Time of a frame now over then: above 1 is slower, and stands first; the largest change first", ["cell", "device", {text: "then, ms", number: true}, {text: "now, ms", number: true}, {text: "now / then", number: true}, {text: "interval", number: true}],
      timed.slice(0, 200).map(c => [cellName(c), c.cell.device, timeDigits(c.old.measured.ms), timeDigits(c.cell.measured.ms), el("span", {class: c.change === "slower" ? "no" : "yes"}, `${ratioDigits(c.ratio.value)} ${c.change}`), `${ratioDigits(c.ratio.low)} to ${ratioDigits(c.ratio.high)}`])) : null);
  return [head("Changes", el("p", {class: "lead"}, changedText()), el("dl", {class: "facts"}, [["Then", DATA.before], ["Now", DATA]].map(([name, source]) => [el("dt", {}, name), el("dd", {}, comparedText(source))]))), slower.length ? times : null,
    verdicts.length ? part("Verdicts", sheet("Claims with another verdict", ["claim", "device", "then", "now", "why now"], verdicts.map(([claim, device, then, now]) => [link("claim", {id: claim.id}, claimWords(claim)), device, badge(then.verdict), badge(now.verdict), now.why || ""]))) : null,
    endings.length || passing.length || gone.length ? part("Cases of the gate", el("p", {}, gatesText()), endings.length ? [endingKey(endings.map(([c]) => c)), tierNote(endings.map(([c]) => c.message)),
      sheet("Cases that ended otherwise, the worst first", ["case", "then", "now", "why now"], endings.map(([c, k]) => [link("gate", {case: c.name}, c.name), k ? ending(k.ending) : "not there", ending(c.ending), c.message || ""]))] : null,
      passing.length ? el("details", {class: "folded"}, el("summary", {}, `${plural(passing.length, "new case")} ${passing.length === 1 ? "passes" : "pass"}`), el("p", {}, list(passing.map(([c]) => c.name)))) : null,
      gone.length ? el("p", {class: "warn"}, `${plural(gone.length, "case")} of the earlier gate ${gone.length === 1 ? "is" : "are"} gone: ${list(gone.slice(0, 20).map(c => c.name))}${gone.length > 20 ? " and others" : ""}.`) : null) : null,
    others.length ? part("Cells", sheet("Cells of tables with another status", ["cell", "device", "then", "now", "why now"], others.map(c => [cellName(c), c.cell.device, status(c.old.status, c.old.detail), status(c.cell.status, c.cell.detail), c.cell.detail || ""]))) : null,
    slower.length ? null : times];
}
