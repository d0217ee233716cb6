"use strict";
// Pictures: A beside B, every two devices, pixels as numbers, strips of frames.

// --- pictures of A and B ---

// What the names of a gate's pictures end in.
const KINDS = [["a", /-a\.png$/, "A"], ["b", /-b\.png$/, "B"], ["flip", /-(flip|seen)\.png$/, "visible difference"], ["heat", /-(heat|size|difference|map)\.png$/, "size of the difference"]];
function picturesOf(attachments) {
  const found = {}, others = [];
  for (const name of attachments) {
    const kind = KINDS.find(([, form]) => form.test(name));
    if (kind && !found[kind[0]]) found[kind[0]] = name; else others.push(name);
  }
  return {found, others};
}
function image(name, alt, cls, loading = "lazy") {
  const data = picture(name);
  return data ? el("img", {src: data, alt, class: cls, loading}) : el("span", {class: "note"}, `${name} is not in this page`);
}
function thumbnails(attachments) {
  const {found, others} = picturesOf(attachments), names = [...KINDS.filter(([k]) => found[k]).map(([k, , text]) => [found[k], text]), ...others.map(o => [o, o])];
  return el("span", {class: "thumbs"}, names.filter(([name]) => picture(name)).map(([name, text]) => image(name, text, "thumb")));
}

// A picture with a ring, which `mark` puts around a pixel.
const ringed = (...pictures) => el("div", {class: "wipe"}, pictures, el("span", {class: "ring", hidden: true, "aria-hidden": "true"}));
const sizeOf = img => [img.naturalWidth || img.width, img.naturalHeight || img.height];
// By how much a map is larger than the picture that it is of. A map has the picture at its upper left, enlarged if it is small, and its scale to the right.
function enlarged(img, width, height) {
  const [w, h] = sizeOf(img);
  return Math.max(1, Math.min(Math.floor(w / width), Math.floor(h / height)));
}
function mark(frame, {x, y, width, height}) {
  const ring = frame.querySelector(".ring"), img = frame.querySelector("img, canvas"), by = img ? enlarged(img, width, height) : 0, [w, h] = img ? sizeOf(img) : [];
  ring.hidden = !img;
  ring.style.left = `${100 * (x + 0.5) * by / w}%`;
  ring.style.top = `${100 * (y + 0.5) * by / h}%`;
}

// Two pictures and what is known of them: {a, b: names of files; of: what the two are called; linear; more: [[file, text]]}. A over
// B, with a divider that a pointer or the arrow keys move; flip; zoom; the pixel that differs most, which all pictures mark; maps.
function sideBySide({a: nameA, b: nameB, of: [textA, textB], linear, more}) {
  const a = image(nameA, `${textA}'s picture`, "pixels", "eager"), b = image(nameB, `${textB}'s picture`, "pixels over", "eager"), map = el("canvas", {class: "pixels", role: "img", "aria-label": `Where ${textA} and ${textB} differ`});
  const maps = more.map(([name, text]) => [image(name, text, "pixels", "eager"), text]), frames = [ringed(a, b), ...maps.map(([img]) => ringed(img)), ringed(map)], worst = el("div", {class: "worst"});
  const slider = el("input", {type: "range", id: "wipe", min: "0", max: "100", value: "50", "aria-label": `Where ${textA} ends and ${textB} begins, from the left`});
  const cut = x => { b.style.clipPath = `inset(0 0 0 ${x}%)`; };
  slider.addEventListener("input", () => cut(slider.value));
  cut(50);
  const flip = el("button", {type: "button", "aria-pressed": "false", onclick: () => {
    const isB = flip.getAttribute("aria-pressed") === "false";
    flip.setAttribute("aria-pressed", String(isB));
    slider.value = isB ? "0" : "100";
    cut(slider.value);
  }}, `Flip between ${textA} and ${textB}`);
  const zoom = el("select", {id: "zoom", onchange: () => resize()}, [1, 2, 4, 8, 16].map(z => el("option", {value: String(z)}, `${z} x`)));
  const resize = () => { for (const img of [a, b, map, ...maps.map(([img]) => img)]) { const [w] = sizeOf(img); if (w && img.style) { img.style.width = w * zoom.value / enlarged(img, ...sizeOf(a)) + "px"; img.style.maxWidth = "none"; } } };
  const figures = el("div", {class: "gallery"});
  decoded([a, b, ...maps.map(([img]) => img)]).then(() => {
    if (a.naturalWidth <= 300) { zoom.value = a.naturalWidth <= 160 ? "4" : "2"; }
    const found = differenceOf(a, b);
    worst.replaceChildren(...worstPixel(a, b, [textA, textB], found));
    if (found && found.worst) {
      const grown = heat(map, found), shown = maps.map(([, text], i) => [frames[1 + i], text]);
      figures.replaceChildren(...[...shown, [frames[frames.length - 1], `Where the two differ: from black, equal, to light yellow, the most${grown ? `; each pixel that differs is drawn ${1 + 2 * grown} pixels wide` : ""}`]].map(([frame, text]) => el("figure", {}, el("div", {class: "scroll", tabindex: "0", role: "region", "aria-label": text}, frame), el("figcaption", {}, text))));
      for (const frame of frames) mark(frame, found);
    } else figures.replaceChildren(...maps.map(([, text], i) => el("figure", {}, frames[1 + i], el("figcaption", {}, text))));
    resize();
  }).catch(() => worst.replaceChildren(note("One of the pictures cannot be decoded.")));
  return el("div", {class: "comparer"}, el("h3", {}, "Pictures"), el("div", {class: "choices"}, el("label", {class: "choice"}, `${textA} | ${textB} `, slider), flip, el("label", {class: "choice"}, "Zoom ", zoom)),
    el("div", {class: "scroll", tabindex: "0", role: "region", "aria-label": `${textA} and ${textB}`}, frames[0]), worst, numbers(linear, textA, textB), figures);
}
const decoded = images => Promise.all(images.map(img => img.decode ? img.decode() : null));
function comparer(attachments) {
  const {found, others} = picturesOf(attachments);
  if (!attachments.length) return null;
  if (!picture(found.a) || !picture(found.b)) return el("div", {class: "gallery"}, attachments.map(name => el("figure", {}, image(name, name, ""), el("figcaption", {}, name))));
  return sideBySide({a: found.a, b: found.b, of: ["A", "B"], linear: linearOf(found.a), more: [...KINDS.slice(2).filter(([k]) => found[k]).map(([k, , text]) => [found[k], text]), ...others.map(o => [o, o])]});
}

// --- linear values ---

const CHANNELS = {1: ["grey"], 2: ["grey", "alpha"], 3: ["red", "green", "blue"], 4: ["red", "green", "blue", "alpha"]};
// Values around the pixels that differ most; `=` is the first picture's value. Null if there are none.
function linearOf(file) {
  const found = DATA.linear && DATA.linear[file];
  if (!found || !CHANNELS[found.channels]) return null;
  const pictures = found.pictures.map(p => ({name: p.name, values: p.values.map(text => text.split(" "))})), base = pictures[0].values;
  return {channels: CHANNELS[found.channels], differing: found.differing, worst: found.worst, pictures: pictures.map(p => ({name: p.name, values: p.values.map((texts, w) => texts.map((text, i) => text === "=" ? base[w][i] : text))}))};
}
// Of two pictures: what they hold where they differ most, and all values around it.
function numbers(linear, textA, textB) {
  const [a, b] = [textA, textB].map(name => linear && linear.pictures.find(p => p.name === name));
  if (!a || !b) return null;
  const {channels, worst} = linear, at = (w, x, y) => ((y - worst[w].top) * worst[w].width + x - worst[w].left) * channels.length;
  const apart = (p, q) => p === q ? "0" : isFinite(q - p) ? String(Number((q - p).toPrecision(3))) : "–";
  const rows = worst.flatMap((t, w) => {
    const pairs = channels.map((c, i) => { const k = at(w, t.x, t.y) + i; return [a.values[w][k], b.values[w][k]]; }), told = (p, q, text) => p === q ? text : el("span", {class: "differs"}, text);
    return [[`x ${t.x}, y ${t.y}`, textA, ...pairs.map(([p, q]) => told(p, q, p))], [el("span", {class: "unseen"}, `x ${t.x}, y ${t.y}`), textB, ...pairs.map(([p, q]) => told(p, q, q))], {cls: "sum", cells: [el("span", {class: "unseen"}, `x ${t.x}, y ${t.y}`), `${textB} − ${textA}`, ...pairs.map(([p, q]) => apart(p, q))]}];
  });
  const grid = el("div", {}), which = el("select", {id: "worst", onchange: () => fill()}, worst.map((t, w) => el("option", {value: String(w)}, `x ${t.x}, y ${t.y}`))), channel = el("select", {id: "channel", onchange: () => fill()}, channels.map((c, i) => el("option", {value: String(i)}, c)));
  const fill = () => {
    const w = Number(which.value), t = worst[w], i = Number(channel.value), xs = d3.range(t.left, t.left + t.width), short = text => isFinite(text) ? String(Number(Number(text).toPrecision(4))) : text;
    grid.replaceChildren(...sheet(`${channels[i]}, linear light, x from left to right, y from top to bottom; where the two differ, ${textA} stands above ${textB}`, ["y", ...xs.map(x => ({text: String(x), number: true}))],
      d3.range(t.top, t.top + t.height).map(y => [String(y), ...xs.map(x => { const k = at(w, x, y) + i, [p, q] = [a.values[w][k], b.values[w][k]]; return p === q ? short(p) : el("span", {class: "differs"}, p, el("br"), q); })]), "grid"));
    const region = grid.querySelector(".scroll"), middle = region.querySelectorAll("tbody tr")[t.y - t.top].children[t.x - t.left + 1];
    middle.classList.add("middle");
    region.scrollLeft = middle.offsetLeft - region.clientWidth / 2;
    region.scrollTop = middle.offsetTop - region.clientHeight / 2;
  };
  return [el("h3", {}, "Linear light"), el("p", {}, `The light of both pictures, after the last stage, before it is rounded to the codes above.${isNumber(linear.differing) && linear.pictures.length === 2 ? ` Counting also what is less than a code, ${plural(linear.differing, "pixel")} ${linear.differing === 1 ? "differs" : "differ"}.` : ""}`),
    sheet(`The ${worst.length === 1 ? "pixel that differs" : `${worst.length} pixels that differ`} most${worst.length === 1 ? "" : ", none within 16 pixels of another"}${linear.pictures.length > 2 ? ", among all devices" : ""}: what ${textA} and ${textB} have there, and the difference`, ["pixel", "of", ...channels.map(c => ({text: c, number: true}))], rows, "texels"),
    el("details", {ontoggle: event => { if (event.target.open) fill(); }}, el("summary", {}, `All values around them, ${worst[0].width} x ${worst[0].height}`), el("div", {class: "choices"}, el("label", {class: "choice"}, "Around ", which), el("label", {class: "choice"}, "Channel ", channel)), grid)];
}

// --- every two devices ---

// Draws where two pictures differ (`differenceOf`): from black, equal, to light yellow, the largest difference. Where few pixels
// differ, each is drawn larger, to be seen; returns by how many pixels on each side.
function heat(canvas, {sizes, width, height, worst, differing}) {
  const context = canvas.getContext("2d"), grown = differing * 200 < width * height ? Math.max(2, Math.round(width / 100)) : 0, shown = grown ? new Uint8Array(sizes.length) : sizes;
  canvas.width = width; canvas.height = height;
  if (grown) for (let i = 0; i < sizes.length; i++) if (sizes[i])
    for (let y = Math.max(0, Math.floor(i / width) - grown); y <= Math.min(height - 1, Math.floor(i / width) + grown); y++)
      for (let x = Math.max(0, i % width - grown); x <= Math.min(width - 1, i % width + grown); x++) shown[y * width + x] = Math.max(shown[y * width + x], sizes[i]);
  const map = context.createImageData(width, height), colours = d3.range(256).map(code => d3.rgb(d3.interpolateMagma(code / 255)));
  shown.forEach((size, i) => { const colour = colours[worst ? Math.round(255 * size / worst) : 0]; map.data.set([colour.r, colour.g, colour.b, 255], 4 * i); });
  context.putImageData(map, 0, 0);
  return grown;
}
const SAME_CODES = "Each pixel has the same 8 bits a channel, as a screen shows it; its linear light may differ by less.";
// One picture if all devices drew it; else a matrix of devices, with the pictures of the chosen two below.
function devicePictures(record, number, params) {
  const drawn = objectsOf(record.document.pictures).filter(p => picture(p.file) && typeof p.device === "string"), digest = p => DATA.files[p.file];
  if (!drawn.length) return null;
  if (new Set(drawn.map(digest)).size === 1)
    return el("figure", {class: "one"}, image(drawn[0].file, "The picture that all drew", ""), el("figcaption", {}, drawn.length > 1 ? `${list(drawn.map(p => p.device))} drew this, to the code.` : `${drawn[0].device} drew this.`));
  const asked = (params.get("pair") || "").split(" "), [p, q] = asked[0] === String(number) ? [1, 2].map(k => drawn[Number(asked[k])]) : [], wide = new Map(), maps = [];
  const cell = (i, k) => {
    if (i === k) return image(drawn[i].file, `${drawn[i].device}'s picture`, "small");
    if (digest(drawn[i]) === digest(drawn[k])) return el("span", {class: "verdict yes", title: SAME_CODES}, "the same codes");
    const canvas = el("canvas", {class: "small", role: "img", "aria-label": `Where ${drawn[i].device} and ${drawn[k].device} differ`});
    maps.push([canvas, i, k]);
    return link("checks", {pair: [number, i, k].join(" ")}, canvas);
  };
  const table = sheet("Pictures of devices as a screen shows them, and where each two differ: black is equal, light yellow the largest difference of the two. A map leads to both pictures", ["device", ...drawn.map(d => d.device)], drawn.map((d, i) => [d.device, ...drawn.map((x, k) => cell(i, k))]), "devices");
  for (const d of drawn) wide.set(digest(d), el("img", {src: picture(d.file)}));
  decoded([...wide.values()]).then(() => { for (const [canvas, i, k] of maps) { const found = differenceOf(wide.get(digest(drawn[i])), wide.get(digest(drawn[k]))); if (found) heat(canvas, found); } }).catch(() => null);
  return [table, p && q ? sideBySide({a: p.file, b: q.file, of: [p.device, q.device], linear: linearOf(drawn[0].file), more: []}) : null];
}

function codesOf(img) {
  const canvas = document.createElement("canvas");
  canvas.width = img.naturalWidth; canvas.height = img.naturalHeight;
  const context = canvas.getContext("2d");
  context.drawImage(img, 0, 0);
  return context.getImageData(0, 0, canvas.width, canvas.height).data;
}
// How far the codes of two pictures differ at each pixel, where most, and at how many pixels; null for pictures of other sizes.
function differenceOf(a, b) {
  if (a.naturalWidth !== b.naturalWidth || a.naturalHeight !== b.naturalHeight) return null;
  const ca = codesOf(a), cb = codesOf(b), width = a.naturalWidth, sizes = new Uint8Array(ca.length / 4);
  let worst = 0, at = 0, differing = 0;
  for (let i = 0; i < ca.length; i += 4) {
    const size = Math.max(Math.abs(ca[i] - cb[i]), Math.abs(ca[i + 1] - cb[i + 1]), Math.abs(ca[i + 2] - cb[i + 2]), Math.abs(ca[i + 3] - cb[i + 3]));
    sizes[i / 4] = size;
    differing += size > 0;
    if (size > worst) { worst = size; at = i / 4; }
  }
  return {sizes, worst, differing, width, height: a.naturalHeight, x: at % width, y: Math.floor(at / width), codes: [ca, cb].map(c => `${c[4 * at]}, ${c[4 * at + 1]}, ${c[4 * at + 2]}`)};
}
// Where the pictures' codes differ most: its place, both values, and the pixels around it.
function worstPixel(a, b, [textA, textB], found) {
  if (!found) return [note("The pictures have different sizes.")];
  if (!found.worst) return [note("The pictures have the same codes; what differs is smaller than a code.")];
  const {x, y, worst, differing, sizes, codes} = found;
  const crop = (img, name) => {
    const canvas = el("canvas", {width: "198", height: "198", role: "img", "aria-label": `${name}: 33 x 33 pixels around ${x}, ${y}`}), context = canvas.getContext("2d");
    context.imageSmoothingEnabled = false;
    context.drawImage(img, x - 16, y - 16, 33, 33, 0, 0, 198, 198);
    for (const [colour, edge] of [["#000", 2], ["#fff", 1]]) { context.strokeStyle = colour; context.lineWidth = edge; context.strokeRect(96 - 1.5 * edge, 96 - 1.5 * edge, 6 + 3 * edge, 6 + 3 * edge); }
    return el("figure", {}, canvas, el("figcaption", {}, name));
  };
  return [el("p", {}, `${plural(differing, "pixel")} of ${sizes.length.toLocaleString("en")} ${differing === 1 ? "differs" : "differ"}. The largest difference is ${worst} of 255, at x ${x}, y ${y}: ${textA} has ${codes[0]}, ${textB} has ${codes[1]} (red, green, blue, in codes, which are 1/255 of what a screen shows). The ring marks it.`),
    el("div", {class: "gallery"}, crop(a, `${textA}, around it`), crop(b, `${textB}, around it`))];
}

// --- pictures ---

const GALLERY = arrayOf(DATA.gallery).filter(g => picture(g.file));
const RENDERS = records("render").filter(r => picture(r.document.file));
const shots = () => [...GALLERY.map(g => [g.file, g.caption, g.printed]), ...RENDERS.map(r => [r.document.file, `${r.document.technique}, frame ${r.document.frame}, on ${r.document.device}`])];
const shot = ([name, caption, printed]) => el("figure", {}, image(name, caption, ""), el("figcaption", {}, caption, printed ? el("p", {class: "printed"}, "The paper’s caption: ", el("q", {}, printed)) : null));
// Frames of a clip that was drawn as numbered pictures, those of them that the page holds.
const numbered = (name, frame) => name.replace(/%0?(\d*)d/, (all, places) => String(frame).padStart(Number(places), "0"));
const STRIPS = records("render").map(r => objectOf(r.document)).filter(d => typeof d.file === "string" && arrayOf(d.frames).length === 2)
  .map(d => ({...d, shown: d3.range(d.frames[0], Math.min(d.frames[1], d.frames[0] + 1e5) + 1).map(frame => [frame, numbered(d.file, frame)]).filter(([, name]) => picture(name))})).filter(d => d.shown.length);
const strip = d => part(`${d.technique} on ${d.device}, frames ${d.frames[0]} to ${d.frames[1]}`, el("div", {class: "scroll", tabindex: "0", role: "region", "aria-label": `Frames of ${d.technique}`}, el("ol", {class: "strip"},
  d.shown.map(([frame, name]) => el("li", {}, image(name, `Frame ${frame}`, ""), el("span", {class: "note", "aria-hidden": "true"}, `frame ${frame}`))))), d.shown.length < d.frames[1] - d.frames[0] + 1 ? note(`${d.shown.length} of ${d.frames[1] - d.frames[0] + 1} frames, evenly spaced.`) : null);
function viewPictures() {
  return [head("Pictures"), el("div", {class: "gallery large"}, shots().map(shot)), STRIPS.map(strip), DATA.pictures_left_out ? note(`${plural(DATA.pictures_left_out, "picture")} had no room in this page.`) : null];
}
