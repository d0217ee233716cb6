"use strict";
// Tables of papers: which rows they have, what is printed of them and what was measured.

const tablesOf = source => records("table", source).map(record => {
  const document = objectOf(record.document), cells = arrayOf(document.cells), printed = record.printed || null;
  const rows = new Map();
  for (const cell of cells) if (!rows.has(cell.row_number)) rows.set(cell.row_number, objectOf(cell.row));
  const variants = arrayOf(document.variants).length ? document.variants : [...new Set(cells.map(c => c.variant))];
  const name = String(document.table), key = machineKey(source, record.machine);
  return {id: onMachine(name, key), name, key, document, cells, printed, rows, variants, file: record.file,
    works: arrayOf(document.works).map(w => w.name), paper: printed ? printed.paper : "", about: printed ? printed.about : words(document.table),
    isTimed: document.timed !== false};
});
const TABLES = tablesOf(DATA);
const tablesNamed = name => TABLES.filter(table => table.name === name);
const tableOf = id => TABLES.find(table => table.id === id) || tablesNamed(id)[0];
const worksOf = table => table.works.length ? table.works : [undefined];
const isCell = (cell, variant, work) => cell.variant === variant && (work === undefined || cell.work === work);
const cellOf = (table, row, device, variant, work) =>
  table.cells.find(c => c.row_number === row && c.device === device && isCell(c, variant, work));

// What tells rows apart: columns of their settings whose values are not all the same.
function keysOf(table) {
  const all = [...table.rows.values()];
  const names = [...new Set(all.flatMap(row => Object.keys(row)))];
  const telling = names.filter(name => new Set(all.map(row => row[name])).size > 1);
  return telling.length ? telling : names.slice(0, 1);
}
const rowText = (row, keys) => keys.filter(key => key in row)
  .map(key => typeof row[key] === "string" && !/^(on|off)$/.test(row[key]) ? row[key] : [nameAndUnit(key)[0], exact(row[key]), nameAndUnit(key)[1]].filter(Boolean).join(" ")).join(", ");

// A row by its number and what tells it apart: "row 4 (culling radius 20 m)". One that was not measured has its settings from print.
function rowName(table, number) {
  const printed = table && table.printed && table.printed.rows[number - 1], keys = printed ? table.printed.columns.slice(0, table.printed.keys) : [];
  const row = table && (table.rows.get(number) || Object.fromEntries(keys.map((key, i) => [key, arrayOf(printed.values)[i]]))), text = row ? rowText(row, keysOf(table)) : "";
  return text ? `row ${number} (${text})` : `row ${number}`;
}

// The axis along which rates go: the first setting of numbers that the rows have in several values. Rows that share its
// values, as those of two cameras, are groups of their own.
function axisOf(table) {
  const keys = keysOf(table), rows = [...table.rows];
  const first = table.printed && table.printed.keys ? table.printed.columns[0] : keys[0];
  const axis = [first, ...keys].find(key => rows.length > 1 && rows.every(([, row]) => isNumber(row[key])) && new Set(rows.map(([, row]) => row[key])).size > 1);
  if (!axis) return {axis: null, groups: [["", rows.map(([n]) => n)]]};
  const values = rows.map(([, row]) => row[axis]);
  if (new Set(values).size === values.length) return {axis, groups: [["", rows.map(([n]) => n)]]};
  const groups = new Map(), others = keys.filter(key => key !== axis);
  for (const [number, row] of rows) {
    const name = rowText(row, others);
    groups.set(name, [...(groups.get(name) || []), number]);
  }
  return {axis, groups: [...groups]};
}

// Frames a second of a cell with its interval; null where it was not timed.
function rateOf(cell) {
  const m = cell && cell.status === "ok" ? objectOf(cell.measured) : {};
  if (!isNumber(m.ms) || m.ms <= 0) return null;
  const bound = ms => isNumber(ms) && ms > 0 ? 1000 / ms : null;
  return {value: 1000 / m.ms, low: bound(m.ms_high), high: bound(m.ms_low)};
}
function printedRate(table, row, variant) {
  if (!table.printed) {
    const cell = table.cells.find(c => c.row_number === row && c.variant === variant && isNumber(objectOf(c.published).fps));
    return cell ? {value: cell.published.fps, low: null, high: null} : null;
  }
  const column = (table.printed.variants.find(v => v.name === variant) || {}).column;
  const values = objectOf(table.printed.rows[row - 1]).values || [], at = name => values[table.printed.columns.indexOf(name)];
  if (column && isNumber(at(column))) return {value: at(column), low: null, high: null};
  const least = at("ms_per_frame_min"), most = at("ms_per_frame_max");
  return isNumber(least) && isNumber(most) && variant === table.variants[0] ? {value: 1000 / Math.sqrt(least * most), low: 1000 / most, high: 1000 / least} : null;
}

// Lines of a table's plot: print and devices, for some of its rows.
function linesOf(table, rows, variant, work, hidden = []) {
  const {axis} = axisOf(table), keys = keysOf(table);
  const point = (number, rate) => rate && {row: number, x: axis ? table.rows.get(number)[axis] : null, label: rowText(table.rows.get(number), keys), ...rate};
  const lines = [{name: "print", points: rows.map(n => point(n, printedRate(table, n, variant))).filter(Boolean)}];
  for (const device of DEVICES)
    lines.push({name: device.name, points: rows.map(n => point(n, rateOf(cellOf(table, n, device.name, variant, work)))).filter(Boolean)});
  return lines.filter(line => line.points.length && !hidden.includes(line.name));
}
// The same by the rate of each line's first row: how the rate goes, whatever the machine.
const normalised = lines => lines.map(line => {
  const first = line.points[0].value, by = x => isNumber(x) ? x / first : null;
  return {...line, points: line.points.map(p => ({...p, value: p.value / first, low: by(p.low), high: by(p.high)}))};
});
// By how much rates fall from the first row of a group to its last, in one sentence that names both.
function story(table, [group, numbers], lines) {
  const {axis} = axisOf(table), falls = lines.filter(line => line.points.length > 1).map(line => [line.name, line.points[0].value / line.points[line.points.length - 1].value]);
  const print = falls.find(([name]) => name === "print"), ours = falls.filter(([name]) => name !== "print").sort((a, b) => a[1] - b[1]);
  if (!axis || !ours.length) return "";
  const [name, unit] = nameAndUnit(axis), at = number => [exact(table.rows.get(number)[axis]), unit].filter(Boolean).join(" "), low = ours[0], high = ours[ours.length - 1];
  const here = ours.length === 1 ? `${digits(low[1])} times on ${low[0]}` : `${digits(low[1])} times (${low[0]}) to ${digits(high[1])} times (${high[0]})`, from = `${name} from ${at(numbers[0])} to ${at(numbers[numbers.length - 1])}`;
  return `${group ? `${group[0].toUpperCase()}${group.slice(1)}, ${from}` : `${from[0].toUpperCase()}${from.slice(1)}`}: ${print ? `in print the first row is ${digits(print[1])} times as fast as the last, here ${here}` : `the first row is ${here} as fast as the last`}.`;
}
// The stories of all groups, such as cameras, the chosen one first.
function stories(table, chosen, variant, work) {
  const {groups} = axisOf(table);
  return [chosen, ...groups.filter(group => group[0] !== chosen[0])].map(group => story(table, group, linesOf(table, group[1], variant, work))).filter(Boolean);
}

// --- the view of all tables, and of one ---

function paperTitle(key) {
  return PAPERS[key] ? PAPERS[key].short : key || "No paper";
}
function viewTables() {
  const papers = [...new Set(TABLES.map(table => table.paper))];
  return [head("Tables", el("p", {}, "Each table of a paper, measured anew: print's numbers beside ours, on every device.")),
    papers.map(paper => part(paperTitle(paper), el("ul", {class: "cards"}, TABLES.filter(t => t.paper === paper).map(table => {
      const claims = CLAIMS.filter(claim => claim.table === table.name);
      return el("li", {}, link("table", {id: table.id}, el("strong", {}, table.id)), el("p", {}, table.about),
        el("p", {class: "note"}, plural(table.rows.size, "row"), ", ", plural(new Set(table.cells.map(c => c.device)).size, "device"),
          claims.length ? [", ", plural(claims.length, "claim")] : null));
    }))))];
}

// What a row drew of something that print counts, such as particles, the same on every device; null if devices tell others or none.
function factOf(table, number, name, variant, work) {
  const told = new Set(table.cells.filter(c => c.row_number === number && isCell(c, variant, work)).map(c => objectOf(c.facts)[name]).filter(isNumber));
  return told.size === 1 ? [...told][0] : null;
}
// Rows that stand side by side: settings, print's numbers as printed, then a rate a device.
function besideRows(table, numbers, variant, work) {
  const keys = Object.keys(objectOf([...table.rows.values()][0])).filter(key => keysOf(table).includes(key) || !table.printed);
  const extra = table.printed && table.printed.is_published ? table.printed.columns.map((name, i) => [name, i]).slice(table.printed.keys) : [];
  const devices = DEVICES.filter(d => table.cells.some(c => c.device === d.name)), ours = (number, name) => factOf(table, number, name, variant, work);
  const isOurs = new Set(extra.map(([name]) => name).filter(name => numbers.some(n => ours(n, name) !== null))), printed = ([name, i], number, values) => isOurs.has(name) ? [exact(values[i]), ours(number, name) === null ? null : el("small", {}, `here ${exact(ours(number, name))}`)] : exact(values[i]);
  const columns = [...keys.map(words), ...extra.map(([name]) => ({text: "print: " + words(name), number: true})), ...devices.map(d => ({text: d.name + (table.isTimed ? ", fps" : ""), number: true}))];
  const plain = [], shown = [];
  for (const number of numbers) {
    const row = table.rows.get(number), values = extra.length ? objectOf(table.printed.rows[number - 1]).values || [] : [];
    const cells = devices.map(d => cellOf(table, number, d.name, variant, work));
    const front = [...keys.map(key => exact(row[key])), ...extra.map(column => printed(column, number, values))];
    plain.push([...keys.map(key => row[key]), ...extra.flatMap(([name, i]) => isOurs.has(name) ? [values[i], ours(number, name)] : [values[i]]), ...cells.map(c => { const r = rateOf(c); return r ? r.value : c ? c.status : ""; })]);
    shown.push([...front, ...cells.map(cell => {
      const rate = rateOf(cell);
      const print = table.printed && (work === undefined || work === "paper") ? printedRate(table, number, variant) : null;
      if (rate) return [digits(rate.value), el("small", {}, between(rate.low, rate.high)), print ? el("small", {}, `${Number((rate.value / print.value).toPrecision(2))} x print`) : null];
      if (!cell) return "";
      if (cell.status !== "ok") return el("span", {class: "bad", title: cell.detail || ""}, cell.status);
      return Object.entries(objectOf(cell.measured)).map(([, v]) => exact(v)).join(" x ");
    })]);
  }
  const heads = columns.flatMap((c, i) => { const name = (extra[i - keys.length] || [])[0]; return isOurs.has(name) ? [c.text, "here: " + words(name)] : [c.text || c]; });
  return {columns, heads, plain, shown};
}

// Each pass's share of a frame, by device, for one row.
function passesOf(table, number, variant, work) {
  const bars = DEVICES.map(d => ({name: d.name, passes: objectOf(objectOf((cellOf(table, number, d.name, variant, work) || {}).measured).passes_ms)}))
    .filter(bar => Object.keys(bar.passes).length);
  if (!bars.length) return null;
  const names = [...new Set(bars.flatMap(b => Object.keys(b.passes)))];
  const sum = bar => d3.sum(Object.values(bar.passes).filter(isNumber));
  const share = (bar, name) => isNumber(bar.passes[name]) ? bar.passes[name] / sum(bar) : 0;
  const top = names.map(name => [name, d3.max(bars, b => share(b, name))]).filter(([, s]) => s >= 0.02).sort((a, b) => b[1] - a[1]).slice(0, 10).map(([n]) => n);
  return sheet("Each pass's time in a frame, and its share of all passes; taken in a run of its own that waits after every pass",
    ["pass", ...bars.map(b => ({text: b.name, number: true}))],
    [...top.map(name => [name, ...bars.map(b => isNumber(b.passes[name]) ? [`${digits(b.passes[name])} ms`, el("small", {}, `${Math.round(100 * share(b, name))} %`), el("meter", {min: 0, max: 1, value: share(b, name), "aria-hidden": "true"})] : "–")]),
      {cls: "sum", cells: ["all passes", ...bars.map(b => `${digits(sum(b))} ms`)]}], "passes");
}

// What the rows drew, as devices tell it: models that stand in for a paper's, and the like.
function inputsOf(table) {
  const told = new Map();
  for (const cell of table.cells)
    for (const [name, value] of Object.entries(objectOf(cell.facts)))
      if (typeof value === "string" && !/hash$/.test(name)) told.set(name, new Set([...(told.get(name) || []), value]));
  return [...told].map(([name, values]) => `${words(name)}: ${[...values].slice(0, 8).join(", ")}`).join("; ");
}
const machineOf = table => objectOf(objectOf(table.document.passport).machine);
// The devices that tables were measured on, each once, as their passports have them.
const measuredOn = tables => [...new Map(tables.flatMap(table => objectsOf(passportOf(table.document).devices).filter(d => table.cells.some(c => c.device === d.name)).map(d => [d.name, d]))).values()];
const machineText = table => { const machine = machineOf(table); return [machine.cpu, machine.cores_allowed ? plural(machine.cores_allowed, "core") : "", machine.distribution].filter(Boolean).join(", "); };
function tableFacts(table) {
  const d = table.document, made = objectOf(objectOf(d.passport).raingauge);
  const work = arrayOf(d.works).map(w => `${w.name}: ${w.reading || w.saves || "what was printed"}`);
  return el("dl", {class: "facts"}, [["Print's machine", d.hardware], ["Our machine", machineText(table)],
    ["Length", [d.length, d.quick ? `with ${d.quick} instead of the paper's own` : ""].filter(Boolean).join(", ")], ["Picture", arrayOf(d.size_px).join(" x ")],
    ["Changed", d.changed], ["Works", work.join("; ")], ["Inputs", inputsOf(table)], ["Note", d.note], ["Interrupted", d.interrupted ? "rows are missing, for the run was interrupted" : ""],
    ["Missing", arrayOf(d.missing).join(" ")], ["Commit", made.commit], ["Record", table.file]]
    .filter(([, text]) => text).map(([name, text]) => [el("dt", {}, name), el("dd", {}, String(text))]));
}

function sweepOf(table, axis) {
  const values = [...new Set([...table.rows.values()].map(row => row[axis]))];
  return table.document.technique && axis && values.every(isNumber)
    ? `raingauge sweep ${shell(table.document.technique)} --axis ${shell(`${axis}=${values.join(",")}`)} --axis ${shell("device=" + [...new Set(table.cells.map(c => c.device))].slice(0, 2).join(","))}` : null;
}

function viewTable(params) {
  const table = tableOf(params.get("id")) || TABLES[0];
  if (!table) return [head("Table"), note("This page holds no table of that name.")];
  const variant = table.variants.includes(params.get("variant")) ? params.get("variant") : table.variants[0];
  const works = worksOf(table), work = works.includes(params.get("work")) ? params.get("work") : works[0];
  const {axis, groups} = axisOf(table), group = groups.find(([name]) => name === params.get("group")) || groups[0];
  const hidden = (params.get("hide") || "").split(",").filter(Boolean), isBy = params.get("scale") !== "fps" && params.get("scale") === "first";
  const rates = linesOf(table, group[1], variant, work), lines = (isBy ? normalised(rates) : rates).filter(line => !hidden.includes(line.name));
  const beside = besideRows(table, [...table.rows.keys()], variant, work);
  const claims = CLAIMS.filter(claim => claim.table === table.name), sweep = sweepOf(table, axis);
  const rowChoice = table.rows.has(Number(params.get("row"))) ? Number(params.get("row")) : [...table.rows.keys()][0];
  return [head(table.id, el("p", {class: "lead"}, table.about), paperTitle(table.paper) && PAPERS[table.paper] ? el("p", {}, PAPERS[table.paper].title, ", ", PAPERS[table.paper].author) : null),
    el("form", {class: "choices", onsubmit: event => event.preventDefault()},
      choice("choose-table", "Table", TABLES.map(t => [t.id, t.id]), table.id, id => { location.hash = href("table", {id}); }),
      choice("choose-variant", "What is timed", table.variants.map(v => [v, words(v)]), variant, v => choose({variant: v})),
      choice("choose-work", "Work", works.map(w => [w, w]), work, w => choose({work: w})),
      !table.isTimed ? null : choice("choose-group", "Rows of", groups.map(([name]) => [name, name]), group[0], name => choose({group: name})),
      table.isTimed && rates.length ? choice("choose-scale", "Rates", [["fps", "frames a second"], ["first", "by the first row"]], isBy ? "first" : "fps", s => choose({scale: s})) : null),
    table.isTimed && rates.length ? part(rates[0].name === "print" ? "Print and devices" : "Devices", stories(table, group, variant, work).map(text => el("p", {class: "story"}, text)),
      plot({lines, all: rates.map(l => l.name), hidden, axis: axis ? words(axis) : null, value: isBy ? "rate by that of the first row" : "frames a second", name: table.id, isLog: !isBy || d3.max(lines.flatMap(l => l.points), p => p.value / d3.max([1e-9, 1])) > 4}),
      note("Bars are intervals that hold the median with 95 % confidence. Print has none.")) : null,
    part(table.printed && table.printed.is_published ? "The table, print beside ours" : "The table", el("p", {class: "machines"}, table.printed && table.printed.is_published && table.document.hardware ? `Print: ${table.document.hardware}. ` : "", machineText(table) ? `Here: ${machineText(table)}. ${kindsText(measuredOn([table]))}` : ""),
      sheet(table.isTimed ? `${table.id}, ${words(variant)}${work ? `, work ${work}` : ""}: frames a second, the interval that holds the median with 95 % confidence, and the rate as a multiple of print`
      : `${table.id}: width and height in pixels`, beside.columns, beside.shown, "beside"),
      el("div", {class: "buttons"}, el("button", {type: "button", onclick: () => save(table.id + ".csv", "text/csv", csv([beside.heads, ...beside.plain]))}, "CSV"))),
    table.isTimed ? part("Where a frame's time goes", choice("choose-row", "Row", [...table.rows].map(([n, row]) => [String(n), rowText(row, keysOf(table))]), String(rowChoice), n => choose({row: n})),
      passesOf(table, rowChoice, variant, work)) : null,
    claims.length ? part("What the paper claims of it", el("div", {class: "claims"}, claims.map(claim => claimBrief(claim)))) : null,
    part("What was run", tableFacts(table), el("h3", {}, "Measure it yourself"), command(`raingauge table ${shell(table.name)} --full -o mine`),
      sweep ? [el("h3", {}, "Vary it"), command(sweep)] : null)];
}
