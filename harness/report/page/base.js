"use strict";
// What all views share: the data, elements, numbers, the address, files to keep.

const DATA = JSON.parse(document.getElementById("data").textContent);

// --- elements ---

// An element; attributes named on... are listeners, null and false leave one out. Texts become text nodes, never markup.
function el(name, attributes = {}, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes || {})) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith("on")) node.addEventListener(key.slice(2), value);
    else node.setAttribute(key, value === true ? "" : value);
  }
  for (const child of children.flat(9)) if (child !== null && child !== undefined && child !== false) node.append(child);
  return node;
}

// A table whose first cells of rows are heads. Columns: texts or {text, number: true, title}.
function sheet(caption, columns, rows, cls = "") {
  const heads = columns.map(c => c && typeof c === "object" ? c : {text: c});
  return [el("p", {class: "caption", "aria-hidden": "true"}, caption), el("div", {class: "scroll", tabindex: "0", role: "region", "aria-label": caption},
    el("table", {class: cls}, el("caption", {class: "unseen"}, caption),
      el("thead", {}, el("tr", {}, heads.map(h => el("th", {scope: "col", class: h.number ? "n" : null, title: h.title}, h.text)))),
      el("tbody", {}, rows.map(row => el("tr", {class: row.cls}, (row.cells || row).map((cell, i) =>
        el(i ? "td" : "th", {scope: i ? null : "row", class: heads[i] && heads[i].number ? "n" : null}, cell)))))))];
}

function choice(id, label, options, value, change) {
  if (options.length < 2) return null;
  return el("label", {class: "choice"}, label + " ",
    el("select", {id, onchange: event => change(event.target.value)},
      options.map(([key, text]) => el("option", {value: key, selected: key === value}, text))));
}

// --- texts and numbers ---

const isNumber = x => typeof x === "number" && isFinite(x);
const plural = (n, one, many) => `${n.toLocaleString("en")} ${n === 1 ? one : many || one + "s"}`;
// A name for people, and its unit, which often stands behind its last underscore: ["culling radius", "m"].
function nameAndUnit(key) {
  const [, name, unit] = /^(.*?)(?:(?<!per)_(m2_s|m|mm|px|ms|s|deg))?$/.exec(String(key)) || [null, String(key)];
  return [name.replace(/_/g, " "), unit === "m2_s" ? "1/(m² s)" : unit || ""];
}
const words = key => nameAndUnit(key).filter(Boolean).join(", ");
const list = texts => texts.length < 2 ? texts.join("") : texts.slice(0, -1).join(", ") + " and " + texts[texts.length - 1];

// Three digits, as many as a median is worth; `hasZeros`: also zeros at their end.
function rounded(x, hasZeros) {
  if (!isNumber(x)) return "–";
  if (x === 0) return "0";
  const value = Number(x.toPrecision(3)), places = Math.max(0, 2 - Math.floor(Math.log10(Math.abs(value))));
  if (places > 6) return x.toExponential(1);
  return value.toLocaleString("en", {maximumFractionDigits: places, minimumFractionDigits: hasZeros ? places : 0});
}
const digits = x => rounded(x, false);
// A time beside others: 4.00 beside 3.73.
const timeDigits = x => rounded(x, true);
// As it is printed: no digit less.
const exact = x => isNumber(x) ? (Math.abs(x) >= 10000 ? x.toLocaleString("en", {maximumFractionDigits: 6}) : String(x)) : x === null || x === undefined ? "" : String(x);
const percent = x => isNumber(x) ? `${x > 0 ? "+" : ""}${digits(100 * x)} %` : "–";
const between = (low, high, text = digits) => isNumber(low) && isNumber(high) ? `${text(low)} to ${text(high)}` : "";
function seconds(x) {
  if (!isNumber(x)) return "–";
  return x < 120 ? `${digits(x)} s` : `${Math.round(x / 60)} min`;
}

// --- the address: #view?key=value&key=value ---

function place() {
  const [view, query] = location.hash.replace(/^#/, "").split("?");
  return {view: view || "overview", params: new URLSearchParams(query || "")};
}
function href(view, params = {}) {
  const query = new URLSearchParams();
  for (const [key, value] of Object.entries(params)) if (value !== null && value !== undefined && value !== "") query.set(key, value);
  const text = query.toString();
  return "#" + view + (text ? "?" + text : "");
}
const link = (view, params, ...children) => el("a", {href: href(view, params)}, ...children);
// Changes what is chosen in this view; the address keeps it, so that it can be sent.
function choose(changes) {
  const {view, params} = place();
  history.replaceState(null, "", href(view, {...Object.fromEntries(params), ...changes}));
  show();
}

// --- files to keep ---

function save(name, type, text) {
  const url = URL.createObjectURL(new Blob([text], {type}));
  const anchor = el("a", {href: url, download: name});
  document.body.append(anchor);
  anchor.click();
  anchor.remove();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}
// RFC 4180. A text that a spreadsheet would run as a formula gets a quote in front.
function csv(rows) {
  const field = x => {
    let text = x === null || x === undefined ? "" : String(x);
    if (typeof x === "string" && /^[=+\-@]/.test(text)) text = "'" + text;
    return /[",\r\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
  };
  return rows.map(row => row.map(field).join(",") + "\r\n").join("");
}
// A command line to copy.
function command(text) {
  const button = el("button", {type: "button", class: "copy", "aria-label": "Copy: " + text}, "Copy");
  button.addEventListener("click", () => {
    const area = el("textarea", {class: "aside", "aria-hidden": "true"});
    area.value = text;
    document.body.append(area);
    area.select();
    button.textContent = document.execCommand("copy") ? "Copied" : "Select it and copy";
    area.remove();
    button.focus();
  });
  return el("div", {class: "command"}, el("code", {}, text), button);
}
// A word of a shell, quoted where it needs it.
const shell = text => /^[\w.,:=/@%+-]+$/.test(text) ? text : `'${String(text).replace(/'/g, "'\\''")}'`;

// --- records ---

const arrayOf = x => Array.isArray(x) ? x : [];
const objectOf = x => x && typeof x === "object" && !Array.isArray(x) ? x : {};
// The objects of an array: what a broken record has between them is left out.
const objectsOf = x => arrayOf(x).filter(y => y && typeof y === "object" && !Array.isArray(y));
const records = (kind, source = DATA) => arrayOf(source.records).filter(record => record.kind === kind);
const picture = name => DATA.pictures[DATA.files[name]] || null;
// A document's passport; a gate has it as a text, which need not be JSON.
function passportOf(document) {
  try { return objectOf(typeof document.passport_text === "string" ? JSON.parse(document.passport_text) : document.passport); } catch (error) { return {}; }
}

// Machines that records come from, by their keys: those of tables, then those of documents of claims, which name theirs from A on, too.
const MACHINES = (() => {
  const found = new Map();
  for (const document of [DATA, ...records("claims").map(record => objectOf(record.document))])
    for (const machine of objectsOf(document.machines)) if (typeof machine.key === "string" && !found.has(machine.key)) found.set(machine.key, machine);
  return [...found.values()].map((machine, i) => ({...machine, name: i < 26 ? String.fromCharCode(65 + i) : `A${i - 25}`}));
})();
const SEVERAL = MACHINES.length > 1;
// The key of the machine that a document calls by this name, and this page's name for it.
const machineKey = (document, name) => (objectsOf(document.machines).find(machine => machine.name === name) || {}).key;
const machineName = key => (MACHINES.find(machine => machine.key === key) || {}).name;
// What stands on a machine, if there are several: "cpu on A".
const onMachine = (text, key) => SEVERAL && machineName(key) ? `${text} on ${machineName(key)}` : text;

// Devices by name, in one order everywhere, so that each keeps its colour and its mark.
const DEVICES = (() => {
  const usual = ["cpu", "cpu:reference", "gl", "vulkan", "opencl"], found = new Map();
  for (const record of arrayOf(DATA.records)) {
    const d = objectOf(record.document);
    for (const device of objectsOf(d.devices))
      if (typeof device.name === "string" && !(found.get(device.name) || {}).driver) found.set(device.name, device);
    for (const cell of objectsOf(d.cells)) if (!found.has(cell.device)) found.set(cell.device, {name: cell.device});
  }
  for (const claim of objectsOf(objectOf(DATA.claims).claims))
    for (const verdict of objectsOf(claim.verdicts)) if (!found.has(verdict.device)) found.set(verdict.device, {name: verdict.device});
  // Gates' passports come last, the newest first: a side may be of another driver than a table's device of its name.
  for (const record of arrayOf(DATA.records).slice().reverse())
    for (const device of objectsOf(passportOf(objectOf(record.document)).devices))
      if (typeof device.name === "string" && !(found.get(device.name) || {}).driver) found.set(device.name, device);
  const order = name => usual.includes(name) ? usual.indexOf(name) : usual.length;
  return [...found.values()].sort((a, b) => order(a.name) - order(b.name));
})();
// What kind of device it is; of one that does not say, what other records say of its name.
const kindOf = device => ({true: "software on the CPU", false: "GPU"}[(typeof device.software === "boolean" ? device : DEVICES.find(d => d.name === device.name) || {}).software]) || "";
// Devices by their kind: "Software on the CPU: cpu and gl. GPU: vulkan."
const kindsText = devices => [...d3.group(devices.filter(kindOf), kindOf)].map(([kind, found]) => `${kind[0].toUpperCase()}${kind.slice(1)}: ${list(found.map(d => d.name))}.`).join(" ");
const deviceIndex = name => Math.max(0, DEVICES.findIndex(d => d.name === name));
const deviceClass = name => name === "print" ? "print" : "d" + deviceIndex(name) % 8;

// --- a view's parts ---

const head = (title, ...children) => el("div", {class: "head"}, el("h1", {}, title), children);
const part = (title, ...children) => el("section", {}, el("h2", {}, title), children);
// A part that links lead to, and such a link within the view that is shown.
const partOf = (id, title, ...children) => el("section", {id}, el("h2", {tabindex: "-1"}, title), children);
const jump = (to, ...children) => el("a", {href: href(place().view, {...Object.fromEntries(place().params), case: null, to}), onclick: event => { if (event.currentTarget.getAttribute("href") === location.hash) show(); }}, ...children);
const note = (...children) => el("p", {class: "note"}, ...children);
