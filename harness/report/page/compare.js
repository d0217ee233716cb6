"use strict";
// Pictures side by side, and what verify, diff, baseline and doctor found.

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
function image(name, alt, cls) {
  const data = picture(name);
  return data ? el("img", {src: data, alt, class: cls, loading: "lazy"}) : el("span", {class: "note"}, `${name} is not in this page`);
}
function thumbnails(attachments) {
  const {found, others} = picturesOf(attachments), names = [...KINDS.filter(([k]) => found[k]).map(([k, , text]) => [found[k], text]), ...others.map(o => [o, o])];
  return el("span", {class: "thumbs"}, names.filter(([name]) => picture(name)).map(([name, text]) => image(name, text, "thumb")));
}

// A over B, with a divider that a pointer or the arrow keys move; flip; maps; zoom; the pixel that differs most.
function comparer(attachments) {
  const {found, others} = picturesOf(attachments);
  if (!attachments.length) return null;
  if (!picture(found.a) || !picture(found.b)) return el("div", {class: "gallery"}, attachments.map(name => el("figure", {}, image(name, name, ""), el("figcaption", {}, name))));
  const a = image(found.a, "A's picture", "pixels"), b = image(found.b, "B's picture", "pixels over"), frame = el("div", {class: "wipe"}, a, b), worst = el("div", {class: "worst"});
  const slider = el("input", {type: "range", id: "wipe", min: "0", max: "100", value: "50", "aria-label": "Where A ends and B begins, from the left"});
  const cut = x => { b.style.clipPath = `inset(0 0 0 ${x}%)`; };
  slider.addEventListener("input", () => cut(slider.value));
  cut(50);
  const flip = el("button", {type: "button", "aria-pressed": "false", onclick: () => {
    const isB = flip.getAttribute("aria-pressed") === "false";
    flip.setAttribute("aria-pressed", String(isB));
    slider.value = isB ? "0" : "100";
    cut(slider.value);
  }}, "Flip between A and B");
  const zoom = el("select", {id: "zoom", onchange: () => resize()}, [1, 2, 4, 8].map(z => el("option", {value: String(z)}, `${z} x`)));
  const resize = () => { for (const img of [a, b]) if (img.naturalWidth) { img.style.width = img.naturalWidth * zoom.value + "px"; img.style.maxWidth = "none"; } };
  Promise.all([a, b].map(img => img.decode ? img.decode() : null)).then(() => {
    if (a.naturalWidth <= 300) { zoom.value = a.naturalWidth <= 160 ? "4" : "2"; }
    resize();
    worst.replaceChildren(...worstPixel(a, b));
  }).catch(() => worst.replaceChildren(note("One of the pictures cannot be decoded.")));
  return el("div", {class: "comparer"}, el("h3", {}, "Pictures"), el("div", {class: "choices"}, el("label", {class: "choice"}, "A | B ", slider), flip, el("label", {class: "choice"}, "Zoom ", zoom)),
    el("div", {class: "scroll", tabindex: "0", role: "region", "aria-label": "A and B"}, frame), worst,
    el("div", {class: "gallery"}, KINDS.slice(2).filter(([k]) => found[k]).map(([k, , text]) => el("figure", {}, image(found[k], text, "pixels"), el("figcaption", {}, text))), others.map(o => el("figure", {}, image(o, o, "pixels"), el("figcaption", {}, o)))));
}

function codesOf(img) {
  const canvas = document.createElement("canvas");
  canvas.width = img.naturalWidth; canvas.height = img.naturalHeight;
  const context = canvas.getContext("2d");
  context.drawImage(img, 0, 0);
  return context.getImageData(0, 0, canvas.width, canvas.height).data;
}
// Where the pictures' codes differ most: its place, both values, and the pixels around it.
function worstPixel(a, b) {
  if (a.naturalWidth !== b.naturalWidth || a.naturalHeight !== b.naturalHeight) return [note("The pictures have different sizes.")];
  const ca = codesOf(a), cb = codesOf(b), width = a.naturalWidth;
  let worst = 0, at = -1, differing = 0;
  for (let i = 0; i < ca.length; i += 4) {
    const most = Math.max(Math.abs(ca[i] - cb[i]), Math.abs(ca[i + 1] - cb[i + 1]), Math.abs(ca[i + 2] - cb[i + 2]));
    differing += most > 0;
    if (most > worst) { worst = most; at = i / 4; }
  }
  if (at < 0) return [note("The pictures have the same codes; what differs is smaller than a code.")];
  const x = at % width, y = Math.floor(at / width), code = c => `${c[4 * at]}, ${c[4 * at + 1]}, ${c[4 * at + 2]}`;
  const crop = (img, name) => {
    const canvas = el("canvas", {width: "198", height: "198", role: "img", "aria-label": `${name}: 33 x 33 pixels around ${x}, ${y}`}), context = canvas.getContext("2d");
    context.imageSmoothingEnabled = false;
    context.drawImage(img, x - 16, y - 16, 33, 33, 0, 0, 198, 198);
    return el("figure", {}, canvas, el("figcaption", {}, name));
  };
  return [el("p", {}, `${plural(differing, "pixel")} of ${(ca.length / 4).toLocaleString("en")} ${differing === 1 ? "differs" : "differ"}. The largest difference is ${worst} of 255, at x ${x}, y ${y}: A has ${code(ca)}, B has ${code(cb)} (red, green, blue).`),
    el("div", {class: "gallery"}, crop(a, "A, around it"), crop(b, "B, around it"))];
}

// --- verify, diff, baseline ---

const statusClass = status => status === "ok" ? "yes" : status === "unsupported" || status === "nothing" ? "other" : "no";
const status = (text, title) => el("span", {class: "verdict " + statusClass(text), title: title || null}, el("span", {"aria-hidden": "true"}, {yes: "✓", no: "✗", other: "○"}[statusClass(text)]), " " + text);

function verifyPart(record) {
  const checks = objectsOf(record.document.checks), devices = [...new Set(checks.map(c => c.device))], rows = [...new Set(checks.map(c => `${c.technique}, ${c.check}`))];
  const bad = checks.filter(c => statusClass(c.status) === "no");
  return part("Verified: " + [...new Set(checks.map(c => c.technique))].join(", "), el("p", {}, bad.length ? `${bad.length} of ${plural(checks.length, "check")} do not hold.` : checks.length ? `None of ${plural(checks.length, "check")} fails.` : "Nothing was checked."),
    sheet("Whether states and pictures are those of the reference, and whether laws hold", ["check", ...devices], rows.map(row => [row, ...devices.map(d => { const c = checks.find(k => `${k.technique}, ${k.check}` === row && k.device === d); return c ? [status(c.status), el("small", {}, c.detail || "")] : ""; })])),
    note(record.file));
}
function diffPart(record) {
  const pairs = objectsOf(record.document.pairs), names = [...new Set(pairs.flatMap(p => [p.a, p.b]))], of = (x, y) => pairs.find(p => (p.a === x && p.b === y) || (p.a === y && p.b === x));
  const same = pairs.filter(p => p.tier === "T0").length;
  const tell = p => p ? [el("span", {class: "verdict " + (p.tier === "T0" ? "yes" : p.tier === "none" ? "no" : "bound")}, p.tier === "T0" ? "identical" : p.tier), p.tier === "T0" ? null : el("small", {}, `${(p.differing || 0).toLocaleString("en")} values, at most ${p.max} of 255`)] : "";
  return part("Pictures of every two devices", el("p", {}, `${same} of ${plural(pairs.length, "pair")} are identical to the last bit.`),
    sheet("How closely each two agree", ["device", ...names], names.map(x => [x, ...names.map(y => x === y ? "–" : tell(of(x, y)))])),
    pairs.filter(p => p.blame).map(p => el("p", {}, el("strong", {}, `${p.a} and ${p.b}: `), objectOf(p.blame).text || "")), objectsOf(record.document.failures).map(f => el("p", {class: "warn"}, `${f.device}: ${f.status}. ${f.detail || ""}`)), note(record.file));
}
const median = xs => d3.median(arrayOf(xs).filter(isNumber));
function baselinePart(record) {
  const cells = objectsOf(record.document.baseline), devices = [...new Set(cells.map(c => c.device))], names = [...new Set(cells.map(c => c.cell))];
  return part("A baseline", el("p", {}, `${plural(names.length, "cell")} on ${plural(devices.length, "device")}, against which later gates are held. ${cells.filter(c => c.outcome !== "ok").length} did not run well.`),
    sheet("Median time of a frame over launches, with the fastest and the slowest launch", ["cell", ...devices.map(d => ({text: d, number: true}))], names.map(name => [name, ...devices.map(d => {
      const c = cells.find(k => k.cell === name && k.device === d), times = c ? arrayOf(c.launches_ms).filter(isNumber) : [];
      return !c ? "" : c.outcome !== "ok" ? status(c.outcome, c.why) : times.length ? [`${digits(median(times))} ms`, el("small", {}, between(d3.min(times), d3.max(times)))] : "not timed";
    })])), note(record.file));
}
function viewChecks() {
  const parts = [...records("verify").map(verifyPart), ...records("diff").map(diffPart), ...records("baseline").map(baselinePart), ...records("bisect").map(bisectPart)];
  return [head("Checks", el("p", {}, "Whether devices compute and draw what the reference does.")), parts];
}
function bisectPart(record) {
  const d = record.document;
  return part("A bisect", el("p", {}, d.end === "found" ? `The first bad one of ${d.candidates}: ${arrayOf(d.first_bad).join(", ")}.` : `${d.end}${arrayOf(d.first_bad).length ? ": " + list(arrayOf(d.first_bad)) : ""}`),
    sheet("In the order in which they were judged", ["candidate", "verdict", {text: "took", number: true}], objectsOf(d.judged).map(j => [j.candidate, j.verdict, seconds(j.seconds)])), note(record.file));
}

// --- devices ---

function viewDevices() {
  const doctors = records("doctor");
  return [head("Devices", el("p", {}, "A device is an API with a driver. Each is asked for the same work.")),
    doctors.map(record => {
      const devices = objectsOf(record.document.devices);
      return part("Doctor", el("p", {}, wellText(devices)), arrayOf(record.document.warnings).map(w => el("p", {class: "warn"}, w)), arrayOf(record.document.missing).map(m => note(m)),
        sheet("What each device can do at most, as measured", ["device", "status", {text: "memory, GB/s", number: true}, {text: "cache, GB/s", number: true}, {text: "arithmetic, Gop/s", number: true}, {text: "dispatch, µs", number: true}, "timer"],
          devices.map(d => [d.name, [status(d.status, d.why), d.why ? el("small", {}, d.why) : null], ...["memory_gb_s", "cache_gb_s", "arithmetic_gop_s"].map(k => digits(objectOf(d.ceilings)[k])), digits(objectOf(d.timer).dispatch_us), d.timer ? d.timer.ratio === null ? "none" : d.timer.trusted ? "tells the truth" : "not trusted" : ""])), note(record.file));
    }),
    part("Drivers", sheet("Who draws", ["device", "API", "driver", "names itself", "kind"], DEVICES.map(d => [d.name, d.api || "", d.driver || "", d.device || "", d.software === true ? "software" : d.software === false ? "hardware" : ""])))];
}
const wellText = devices => `${devices.filter(d => d.status === "ok").length} of ${plural(devices.length, "device")} are well: they work, and compute what C computes.`;

// --- pictures ---

const GALLERY = arrayOf(DATA.gallery).filter(g => picture(g.file));
const RENDERS = records("render").filter(r => picture(r.document.file));
const shots = () => [...GALLERY.map(g => [g.file, g.caption]), ...RENDERS.map(r => [r.document.file, `${r.document.technique}, frame ${r.document.frame}, on ${r.document.device}`])];
const shot = ([name, caption]) => el("figure", {}, image(name, caption, ""), el("figcaption", {}, caption));
function viewPictures() {
  return [head("Pictures"), el("div", {class: "gallery large"}, shots().map(shot)), DATA.pictures_left_out ? note(`${plural(DATA.pictures_left_out, "picture")} had no room in this page.`) : null];
}
