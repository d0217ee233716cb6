"use strict";
// Plots: rates over an axis, or rates of named rows; ratios with intervals. Each has its numbers as a table and as files.

const MARKS = [d3.symbolCircle, d3.symbolSquare, d3.symbolTriangle, d3.symbolDiamond, d3.symbolStar, d3.symbolWye, d3.symbolCross];
const markOf = name => d3.symbol().type(name === "print" ? d3.symbolDiamond : MARKS[deviceIndex(name) % MARKS.length]).size(name === "print" ? 90 : 52)();
const widthOf = () => Math.max(300, Math.min(900, document.documentElement.clientWidth - (document.documentElement.clientWidth < 600 ? 34 : 90)));

function svgOf(width, height, label) {
  return d3.create("svg").attr("viewBox", `0 0 ${width} ${height}`).attr("width", width).attr("height", height).attr("role", "img").attr("aria-label", label);
}

// The scale of values, with room for their intervals; ticks at 1, 2 and 5.
function scaleOf(points, isLog, range) {
  const all = points.flatMap(p => [p.value, p.low, p.high]).filter(x => isNumber(x) && x > 0);
  const [least, most] = d3.extent(all);
  return isLog ? d3.scaleLog().domain([least / 1.15, most * 1.15]).range(range) : d3.scaleLinear().domain([Math.min(0, least), most * 1.05]).range(range).nice();
}
function ticksOf(scale, isLog, most) {
  if (!isLog) return scale.ticks(most);
  const [least, last] = scale.domain(), all = d3.range(Math.floor(Math.log10(least)), Math.ceil(Math.log10(last)) + 1).flatMap(e => [1, 2, 5].map(m => m * 10 ** e)).filter(x => x >= least && x <= last);
  const tens = all.filter(x => /^1(e|0|\.|$)/.test(x.toExponential()));
  return all.length <= most || tens.length < 2 ? all : tens;
}
// Digits that the steps between ticks need, and no more.
const tickText = x => x >= 1 || x === 0 ? d3.format("~r")(Number(x.toPrecision(6))) : String(Number(x.toPrecision(3)));

// A point with its interval, as a mark that a pointer and a reader can ask.
function drawPoint(group, name, p, x, y, ends, isAcross) {
  const node = group.append("g").attr("class", "point " + deviceClass(name));
  node.append("title").text(`${name}, ${p.label}: ${digits(p.value)}${between(p.low, p.high) ? ` (${between(p.low, p.high)})` : ""}`);
  if (ends) node.append("path").attr("class", "interval").attr("d", isAcross ? `M${ends[0]},${y}H${ends[1]}M${ends[0]},${y - 4}v8M${ends[1]},${y - 4}v8` : `M${x},${ends[0]}V${ends[1]}M${x - 4},${ends[0]}h8M${x - 4},${ends[1]}h8`);
  node.append("path").attr("class", "mark").attr("d", markOf(name)).attr("transform", `translate(${x},${y})`);
}

// Labels at the ends of lines, moved apart where they would cover each other.
function drawEnds(svg, lines, x, y, room) {
  const ends = lines.map(line => ({name: line.name, y: y(line.points[line.points.length - 1].value)})).sort((a, b) => a.y - b.y);
  for (let i = 1; i < ends.length; i++) ends[i].y = Math.max(ends[i].y, ends[i - 1].y + 14);
  const over = ends.length ? ends[ends.length - 1].y - room : 0;
  if (over > 0) for (let i = ends.length - 1, limit = room; i >= 0; i--, limit -= 14) ends[i].y = Math.min(ends[i].y, limit);
  for (const end of ends) svg.append("text").attr("class", "end " + deviceClass(end.name)).attr("x", x).attr("y", end.y).attr("dy", "0.32em").text(end.name);
}

function drawAxis({lines, axis, value, isLog, name}) {
  const width = widthOf(), height = width < 500 ? 320 : 400, isNarrow = width < 500;
  const edge = {left: 52, right: isNarrow ? 14 : 96, top: 14, bottom: 44};
  const points = lines.flatMap(line => line.points), xs = [...new Set(points.map(p => p.x))].sort((a, b) => a - b);
  const wide = xs[0] > 0 && xs[xs.length - 1] / xs[0] > 20;
  const x = (wide ? d3.scaleLog() : d3.scaleLinear()).domain(d3.extent(xs)).range([edge.left + 14, width - edge.right - 14]);
  const y = scaleOf(points, isLog, [height - edge.bottom, edge.top]);
  const svg = svgOf(width, height, `${name}: ${value} over ${axis}; the numbers stand in the table below`);
  const shown = [];
  for (const v of xs) if (!shown.length || x(v) - x(shown[shown.length - 1]) > (isNarrow ? 44 : 52)) shown.push(v);
  svg.append("g").attr("class", "axis").attr("transform", `translate(0,${height - edge.bottom})`).call(d3.axisBottom(x).tickValues(shown).tickFormat(v => exact(v)).tickSizeOuter(0));
  svg.append("g").attr("class", "axis grid").attr("transform", `translate(${edge.left},0)`).call(d3.axisLeft(y).tickValues(ticksOf(y, isLog, 9)).tickFormat(tickText).tickSize(-(width - edge.left - edge.right)));
  svg.append("text").attr("class", "title").attr("x", edge.left + (width - edge.left - edge.right) / 2).attr("y", height - 6).attr("text-anchor", "middle").text(axis);
  svg.append("text").attr("class", "title").attr("transform", `translate(12,${edge.top + (height - edge.top - edge.bottom) / 2}) rotate(-90)`).attr("text-anchor", "middle").text(value + (isLog ? ", logarithmic" : ""));
  for (const line of lines) {
    const group = svg.append("g"), sorted = [...line.points].sort((a, b) => a.x - b.x);
    group.append("path").attr("class", "line " + deviceClass(line.name)).attr("d", d3.line().x(p => x(p.x)).y(p => y(p.value))(sorted));
    for (const p of sorted) drawPoint(group, line.name, p, x(p.x), y(p.value), isNumber(p.low) && isNumber(p.high) ? [y(p.low), y(p.high)] : null, false);
  }
  if (!isNarrow) drawEnds(svg, lines.map(l => ({...l, points: [...l.points].sort((a, b) => a.x - b.x)})), width - edge.right + 2, y, height - edge.bottom);
  return svg.node();
}

function drawNamed({lines, value, isLog, name}) {
  const labels = [...new Set(lines.flatMap(line => line.points.map(p => p.label)))], step = Math.max(30, 12 + 8 * lines.length);
  const width = widthOf(), isNarrow = width < 500, longest = d3.max(labels, l => l.length) || 0;
  const edge = {left: isNarrow ? 12 : Math.min(260, 16 + 7 * longest), right: 16, top: 8, bottom: 44}, head = isNarrow ? 16 : 0;
  const height = edge.top + edge.bottom + labels.length * (step + head);
  const points = lines.flatMap(line => line.points), x = scaleOf(points, isLog, [edge.left + 8, width - edge.right - 8]);
  const svg = svgOf(width, height, `${name}: ${value} of each row; the numbers stand in the table below`), bottom = height - edge.bottom;
  svg.append("g").attr("class", "axis grid").attr("transform", `translate(0,${bottom})`).call(d3.axisBottom(x).tickValues(ticksOf(x, isLog, isNarrow ? 5 : 9)).tickFormat(tickText).tickSize(-(bottom - edge.top)));
  svg.append("text").attr("class", "title").attr("x", edge.left + (width - edge.left - edge.right) / 2).attr("y", height - 6).attr("text-anchor", "middle").text(value + (isLog ? ", logarithmic" : ""));
  labels.forEach((label, i) => {
    const top = edge.top + i * (step + head), inner = step / (lines.length + 1);
    if (i) svg.append("path").attr("class", "rule").attr("d", `M${isNarrow ? 0 : 4},${top}H${width - edge.right}`);
    svg.append("text").attr("class", "label").attr("x", isNarrow ? 2 : edge.left - 8).attr("y", isNarrow ? top + 13 : top + step / 2).attr("dy", isNarrow ? 0 : "0.32em").attr("text-anchor", isNarrow ? "start" : "end").text(label);
    lines.forEach((line, k) => {
      const p = line.points.find(q => q.label === label), at = top + head + inner * (k + 1);
      if (p) drawPoint(svg.append("g"), line.name, p, x(p.value), at, isNumber(p.low) && isNumber(p.high) ? [x(p.low), x(p.high)] : null, true);
    });
  });
  return svg.node();
}

// --- what can be kept of a plot ---

// The plot as a file of its own, with the looks that the page's style gives it, dark on white.
function svgText(svg) {
  const root = document.documentElement, before = root.getAttribute("data-theme");
  root.setAttribute("data-theme", "light");
  const copy = svg.cloneNode(true), from = svg.querySelectorAll("*"), to = copy.querySelectorAll("*");
  const kept = ["fill", "stroke", "stroke-width", "stroke-dasharray", "stroke-opacity", "opacity", "font-size", "font-family", "font-weight"];
  from.forEach((node, i) => {
    const looks = getComputedStyle(node);
    for (const key of kept) to[i].setAttribute(key, looks.getPropertyValue(key));
    to[i].removeAttribute("class");
  });
  if (before) root.setAttribute("data-theme", before); else root.removeAttribute("data-theme");
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  return new XMLSerializer().serializeToString(copy);
}
function pgfplots({lines, axis, value, isLog, name}) {
  const tex = text => String(text).replace(/[\\{}$&#^_%~]/g, c => c === "_" || c === "&" || c === "#" || c === "%" || c === "$" || c === "{" || c === "}" ? "\\" + c : " ");
  const labels = [...new Set(lines.flatMap(l => l.points.map(p => p.label)))];
  const options = axis ? [`xlabel={${tex(axis)}}`, `ylabel={${tex(value)}}`, isLog ? "ymode=log" : null]
    : [`xlabel={${tex(value)}}`, isLog ? "xmode=log" : null, `ytick={${labels.map((_, i) => i + 1).join(",")}}`, `yticklabels={${labels.map(l => `{${tex(l)}}`).join(",")}}`, "y dir=reverse"];
  const rows = line => line.points.map(p => {
    const up = isNumber(p.high) ? p.high - p.value : 0, down = isNumber(p.low) ? p.value - p.low : 0;
    return axis ? `    ${p.x} ${p.value} ${up} ${down}` : `    ${p.value} ${labels.indexOf(p.label) + 1} ${up} ${down}`;
  }).join("\n");
  const bars = axis ? "y" : "x";
  return `% ${name}, by raingauge\n\\begin{tikzpicture}\n\\begin{axis}[${options.filter(Boolean).join(", ")}, legend pos=outer north east]\n` + lines.map(line =>
    `  \\addplot+[error bars/.cd, ${bars} dir=both, ${bars} explicit] table [x index=0, y index=1, ${bars} error plus index=2, ${bars} error minus index=3] {\n${rows(line)}\n  };\n  \\addlegendentry{${tex(line.name)}}\n`).join("") + "\\end{axis}\n\\end{tikzpicture}\n";
}
function plotRows({lines, axis, value}) {
  return [["line", axis || "row", value, "low", "high"], ...lines.flatMap(line => line.points.map(p => [line.name, axis ? p.x : p.label, p.value, p.low, p.high]))];
}

// A plot with its legend, its numbers and its files. `all` and `hidden`: the lines that the legend can show and hide.
function plot(asked) {
  const {lines, all, hidden, axis, value, name} = asked;
  const points = lines.flatMap(line => line.points), isOver = axis && new Set(points.map(p => p.x)).size > 1;
  const told = {...asked, axis: isOver ? axis : null};
  const toggle = line => choose({hide: hidden.includes(line) ? hidden.filter(h => h !== line).join(",") : [...hidden, line].join(",")});
  const key = line => { const svg = svgOf(18, 14, ""); svg.attr("role", null).attr("aria-label", null).attr("aria-hidden", "true").append("path").attr("class", "mark " + deviceClass(line)).attr("d", markOf(line)).attr("transform", "translate(9,7)"); return svg.node(); };
  const legend = !all ? el("ul", {class: "legend"}, lines.map(line => el("li", {}, key(line.name), line.name))) : el("div", {class: "legend", role: "group", "aria-label": "Lines that are shown"}, all.map(line =>
    el("button", {type: "button", id: "line-" + line, "aria-pressed": hidden.includes(line) ? "false" : "true", onclick: () => toggle(line)}, key(line), line)));
  if (!points.length) return el("figure", {class: "plot"}, legend, note("Nothing is shown: choose a line."));
  const svg = isOver ? drawAxis(told) : drawNamed(told), rows = plotRows(told);
  return el("figure", {class: "plot"}, legend, svg,
    el("details", {}, el("summary", {}, "The plot's numbers"), sheet(`${name}: ${value}`, rows[0].map((c, i) => i > 1 ? {text: c, number: true} : c),
      rows.slice(1).map(row => [row[0], exact(row[1]), ...row.slice(2).map(digits)]))),
    el("div", {class: "buttons"}, [["CSV", ".csv", "text/csv", () => csv(rows)], ["SVG", ".svg", "image/svg+xml", () => svgText(svg)], ["pgfplots", ".tex", "text/x-tex", () => pgfplots(told)]]
      .map(([label, end, type, make]) => el("button", {type: "button", onclick: () => save(name + end, type, make())}, label))));
}
