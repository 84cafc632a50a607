// The page's own script: tabs, the choice of a component, colours, and plots drawn with d3 where it is there.
(() => {
"use strict";
const d3 = window.d3;
const all = (selector, root = document) => [...root.querySelectorAll(selector)];
const data = JSON.parse(document.getElementById("data").textContent);

// -- colours ---------------------------------------------------------------------------------------------
document.getElementById("theme").addEventListener("click", () => {
  const root = document.documentElement;
  const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = dark ? "light" : "dark";
});

// -- tabs --------------------------------------------------------------------------------------------------
const tabs = all("[role=tab]");
function showTab(tab, focus) {
  for (const other of tabs) {
    const chosen = other === tab;
    other.setAttribute("aria-selected", chosen);
    other.tabIndex = chosen ? 0 : -1;
    document.getElementById(other.getAttribute("aria-controls")).hidden = !chosen;
  }
  if (focus) tab.focus();
  drawVisible();
}
tabs.forEach((tab, i) => {
  tab.addEventListener("click", () => showTab(tab));
  tab.addEventListener("keydown", event => {
    const to = { ArrowRight: i + 1, ArrowLeft: i - 1, Home: 0, End: tabs.length - 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    showTab(tabs[(to + tabs.length) % tabs.length], true);
  });
});

// -- components --------------------------------------------------------------------------------------------
const cards = new Map(all(".card").map(card => [card.dataset.card, card]));
const places = new Map();
// The card of what is drawn: of a list of components that is one box, the first one's.
function carded(path) {
  return cards.has(path) ? path : [...cards.keys()].find(other => other.startsWith(path + "["));
}
for (const place of all("[data-component]")) {
  const path = carded(place.dataset.component);
  if (path === undefined) continue;
  places.set(path, [...(places.get(path) || []), place]);
  if (place.tagName !== "BUTTON") {
    place.tabIndex = 0;
    place.setAttribute("role", "button");
    if (!place.hasAttribute("aria-label")) place.setAttribute("aria-label", path);
    place.addEventListener("keydown", event => {
      if (event.key === "Enter" || event.key === " ") { event.preventDefault(); choose(path, true); }
    });
  }
  place.addEventListener("click", event => { event.stopPropagation(); choose(path, true); });
}
function choose(path, note) {
  if (!cards.has(path)) return;
  for (const [other, card] of cards) card.hidden = other !== path;
  for (const [other, found] of places) for (const place of found) {
    place.classList.toggle("chosen", other === path);
    place.setAttribute("aria-pressed", other === path);
  }
  if (note) history.replaceState(null, "", "#" + encodeURIComponent(path));
  drawVisible();
}

// -- plots ---------------------------------------------------------------------------------------------------
const MARGIN = { top: 8, right: 14, bottom: 38, left: 72 };
const groups = new Map();
let serial = 0;
const unpacked = new Map();
function read(i) {
  if (i < 0) return null;
  if (!unpacked.has(i)) unpacked.set(i, unpack(data.arrays[i]));
  return unpacked.get(i);
}
function unpack(array) {
  if (Array.isArray(array)) return array;
  const bytes = Uint8Array.from(atob(array.packed), c => c.charCodeAt(0)).buffer;
  const levels = array.gap > 65535 ? new Uint32Array(bytes) : new Uint16Array(bytes);
  return Array.from(levels, level => level === array.gap ? null : array.low + array.span * (level / (array.gap - 1)));
}
// Of the rows in view only those that can be seen: in every column of pixels the first, the lowest and the highest.
function seen(c, from, to, columns) {
  if (to - from < 4 * columns) return d3.range(from, to);
  const rows = [], size = (to - from) / columns;
  for (let k = 0; k < columns; k++) {
    const first = from + Math.floor(k * size), last = from + Math.floor((k + 1) * size);
    let low = first, high = first;
    for (let i = first; i < last; i++) {
      if (c.ys[i] === null) continue;
      if (c.ys[low] === null || c.ys[i] < c.ys[low]) low = i;
      if (c.ys[high] === null || c.ys[i] > c.ys[high]) high = i;
    }
    for (const i of new Set([first, Math.min(low, high), Math.max(low, high)])) rows.push(i);
  }
  return rows.concat(to - 1);
}
const written = value => value === null || value === undefined || !isFinite(value) ? "" : Number(value.toPrecision(5)).toString();

function matched(parent, tag, rows) {
  const found = parent.selectAll(tag).data(rows);
  found.exit().remove();
  return found.enter().append(tag).merge(found);
}
function nearest(xs, x) {
  const i = d3.bisectLeft(xs, x);
  return i > 0 && (i >= xs.length || x - xs[i - 1] < xs[i] - x) ? i - 1 : i;
}

function drawPlot(figure) {
  const spec = data.plots[figure.dataset.plot];
  const curves = spec.curves.map(c => ({ ...c, xs: read(c.x), ys: read(c.y), s: read(c.sigma), ends: c.band.map(read), shown: true }));
  const height = spec.low ? 150 : 270;
  const bar = d3.select(figure).insert("div", "figcaption").attr("class", "bar");
  const svg = d3.select(figure).insert("svg", "figcaption").attr("tabindex", 0).attr("role", "img")
    .attr("aria-label", `${spec.caption || spec.ylabel + " over " + spec.xlabel}. Arrow keys move the cursor, with shift the view; plus and minus zoom; 0 shows all.`);
  const number = serial++;
  svg.append("clipPath").attr("id", "clip" + number).append("rect");
  const back = svg.append("g"), inside = svg.append("g").attr("clip-path", `url(#clip${number})`);
  const shades = inside.append("g"), marks = inside.append("g"), strips = inside.append("g");
  const xAxis = svg.append("g"), yAxis = svg.append("g");
  const xLabel = svg.append("text").attr("class", "label").attr("text-anchor", "middle").text(spec.xlabel);
  const yLabel = svg.append("text").attr("class", "label").attr("text-anchor", "middle").text(spec.ylabel);
  const cursor = svg.append("line").attr("class", "cursor").attr("visibility", "hidden");
  for (const c of curves) {
    c.key = bar.append("button").attr("type", "button").attr("class", "key " + c.color).attr("aria-pressed", true)
      .on("click", () => { c.shown = !c.shown; c.key.attr("aria-pressed", c.shown); redraw(); });
    c.key.append("span").text(c.label);
    c.value = c.key.append("output");
    if (c.ends.length) c.strip = strips.append("path").attr("class", "band " + c.color);
    c.path = inside.append("path").attr("class", "curve " + c.color);
    if (c.dots) c.dotted = inside.append("g").attr("class", c.color);
    c.spot = svg.append("circle").attr("class", "dot " + c.color).attr("r", 3.5).attr("visibility", "hidden");
  }
  const at = bar.append("output").attr("class", "at");
  const tools = bar.append("span").attr("class", "tools");
  for (const [sign, name, act] of [["−", "Zoom out", () => zoomBy(1 / 1.6)], ["+", "Zoom in", () => zoomBy(1.6)], ["↺", "Show all", reset]])
    tools.append("button").attr("type", "button").attr("title", name).attr("aria-label", name).text(sign).on("click", act);

  const full = d3.extent(curves.flatMap(c => d3.extent(c.xs)));
  if (full[0] === full[1]) { full[0] -= .5; full[1] += .5; }
  const x = d3.scaleLinear().domain(full), y = spec.log ? d3.scaleLog() : d3.scaleLinear();
  let xs = x, width = 0, view = d3.zoomIdentity, place = null;

  const zoom = d3.zoom().scaleExtent([1, 5000])
    .filter(() => {
      const event = d3.event;
      if (event.type === "wheel") return event.ctrlKey || event.metaKey || document.activeElement === svg.node();
      if (event.type.startsWith("touch")) return event.touches.length > 1 || view.k > 1;
      return event.type !== "dblclick" && !event.button;
    })
    .on("zoom", () => { for (const peer of peers()) peer.apply(d3.event.transform); });
  function peers() { return spec.group ? groups.get(spec.group) : [self]; }
  function zoomBy(factor) { svg.call(zoom.scaleBy, factor); }
  function reset() { svg.call(zoom.transform, d3.zoomIdentity); }

  function extent() {
    if (spec.limits) return spec.limits;
    let low = Infinity, high = -Infinity;
    const [a, b] = xs.domain();
    for (const c of curves) {
      if (!c.shown) continue;
      const from = Math.max(0, d3.bisectLeft(c.xs, a) - 1), to = Math.min(c.xs.length, d3.bisectRight(c.xs, b) + 1);
      for (let i = from; i < to; i++) {
        const v = c.ys[i];
        if (v === null || (spec.log && v <= 0)) continue;
        if (v < low) low = v;
        if (v > high) high = v;
      }
    }
    if (!(low <= high)) return spec.log ? [.1, 1] : [0, 1];
    if (spec.log) return low === high ? [low / 2, high * 2] : [low / 1.1, high * 1.1];
    const room = high > low ? .06 * (high - low) : Math.max(Math.abs(high) * .05, 1e-12);
    return [low - room, high + room];
  }
  function redraw() {
    xs = view.rescaleX(x);
    y.domain(extent());
    const [a, b] = xs.domain();
    const right = width - MARGIN.right, bottom = height - MARGIN.bottom;
    xAxis.attr("transform", `translate(0,${bottom})`).call(d3.axisBottom(xs).ticks(Math.max(3, width / 90)).tickSizeOuter(0))
      .selectAll("text").attr("dx", function (v) { return Math.min(0, width - 1 - this.getComputedTextLength() / 2 - xs(v)); });
    const largest = Math.max(...y.domain().map(Math.abs));
    const ticks = d3.axisLeft(y).ticks(spec.low ? 3 : 6, spec.log ? "~g" : largest < 1e-3 || largest >= 1e6 ? ".3~e" : undefined)
      .tickSizeOuter(0);
    yAxis.attr("transform", `translate(${MARGIN.left},0)`).call(ticks);
    const levels = y.ticks(spec.low ? 3 : 6);
    matched(back, "path", [levels]).attr("class", "grid")
      .attr("d", levels.map(v => `M${MARGIN.left},${y(v)}H${right}`).join(""));
    const shaded = spec.trusted ? [[full[0], spec.trusted[0]], [spec.trusted[1], full[1]]].filter(([l, h]) => h > l) : [];
    matched(shades, "rect", shaded).attr("class", "shade").attr("x", d => xs(d[0])).attr("y", MARGIN.top)
      .attr("width", d => xs(d[1]) - xs(d[0])).attr("height", bottom - MARGIN.top);
    matched(shades, "line", spec.guides).attr("class", "guide")
      .attr("x1", xs).attr("x2", xs).attr("y1", MARGIN.top).attr("y2", bottom);
    matched(marks, "path", spec.samples.length ? [spec.samples] : []).attr("class", "sample")
      .attr("d", d => d.map(v => `M${xs(v).toFixed(1)},${bottom}v-7`).join(""));
    for (const c of curves) {
      const from = Math.max(0, d3.bisectLeft(c.xs, a) - 1), to = Math.min(c.xs.length, d3.bisectRight(c.xs, b) + 1);
      const rows = c.shown ? seen(c, from, to, Math.ceil(width)) : [];
      const there = i => c.ys[i] !== null && (!spec.log || c.ys[i] > 0);
      const line = d3.line().defined(there).x(i => xs(c.xs[i])).y(i => y(c.ys[i]));
      c.path.attr("d", (c.steps ? line.curve(d3.curveStepAfter) : line)(rows));
      if (c.strip) c.strip.attr("d", d3.area().defined(i => there(i) && c.ends.every(e => e[i] !== null)).x(i => xs(c.xs[i]))
        .y0(i => y(c.ends[0][i])).y1(i => y(c.ends[1][i]))(rows));
      if (c.dotted) matched(c.dotted, "circle", rows.filter(there)).attr("class", "dot").attr("r", 2.2)
        .attr("cx", i => xs(c.xs[i])).attr("cy", i => y(c.ys[i]));
    }
    point(place);
  }
  function resize() {
    const now = figure.clientWidth;
    if (!now || now === width) return;
    width = now;
    const right = width - MARGIN.right, bottom = height - MARGIN.bottom;
    svg.attr("viewBox", `0 0 ${width} ${height}`).attr("height", height);
    svg.select("clipPath rect").attr("x", MARGIN.left).attr("y", MARGIN.top)
      .attr("width", right - MARGIN.left).attr("height", bottom - MARGIN.top);
    x.range([MARGIN.left, right]);
    y.range([bottom, MARGIN.top]);
    xLabel.attr("x", (MARGIN.left + right) / 2).attr("y", height - 4);
    yLabel.attr("transform", `translate(12,${(MARGIN.top + bottom) / 2}) rotate(-90)`);
    cursor.attr("y1", MARGIN.top).attr("y2", bottom);
    const box = [[MARGIN.left, 0], [right, height]];
    zoom.extent(box).translateExtent(box);
    redraw();
  }
  function point(value) {
    place = value;
    const [a, b] = xs.domain(), outside = value === null || value < a || value > b;
    cursor.attr("visibility", outside ? "hidden" : "visible");
    at.text(outside ? "" : `${spec.xlabel.split(" [")[0]} ${written(value)}`);
    if (!outside) cursor.attr("x1", xs(value)).attr("x2", xs(value));
    for (const c of curves) {
      const i = outside || !c.shown || value < c.xs[0] || value > c.xs[c.xs.length - 1] ? -1 : nearest(c.xs, value);
      const v = i < 0 ? null : c.ys[i];
      const inView = v !== null && v >= Math.min(...y.domain()) && v <= Math.max(...y.domain());
      c.value.text(v === null ? "" : written(v) + (c.s && c.s[i] !== null ? " ± " + Number(c.s[i].toPrecision(2)) : ""));
      c.spot.attr("visibility", inView ? "visible" : "hidden");
      if (inView) c.spot.attr("cx", xs(c.xs[i])).attr("cy", y(v));
    }
  }
  function pointAll(value) { for (const peer of peers()) peer.point(value); }
  const self = { apply(transform) { view = svg.node().__zoom = transform; redraw(); }, point, resize };
  if (spec.group) groups.set(spec.group, [...(groups.get(spec.group) || []), self]);
  svg.call(zoom).on("dblclick.reset", reset)
    .on("pointerdown.cursor pointermove.cursor", () => pointAll(xs.invert(d3.mouse(svg.node())[0])))
    .on("pointerleave.cursor", () => pointAll(null))
    .on("mousedown.focus", () => svg.node().focus({ preventScroll: true }))
    .on("keydown", () => {
      const event = d3.event, [a, b] = xs.domain(), step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (event.key === "+" || event.key === "=") zoomBy(1.6);
      else if (event.key === "-") zoomBy(1 / 1.6);
      else if (event.key === "0" || event.key === "Escape") reset();
      else if (step && event.shiftKey) svg.call(zoom.translateBy, -step * (x.range()[1] - x.range()[0]) / 8 / view.k, 0);
      else if (step) pointAll(Math.min(b, Math.max(a, (place === null ? (a + b) / 2 : place) + step * (b - a) / 100)));
      else return;
      event.preventDefault();
    });
  if (spec.group) {
    const other = groups.get(spec.group)[0];
    if (other !== self && other.view) view = svg.node().__zoom = other.view();
  }
  self.view = () => view;
  resize();
  return self;
}

const drawn = new Map();
function drawVisible(everywhere) {
  if (!d3) return;
  for (const figure of all(".plot")) {
    if (!figure.offsetParent) continue;
    if (drawn.has(figure)) drawn.get(figure).resize();
    else {
      const box = figure.getBoundingClientRect();
      if (everywhere || box.top < innerHeight + 600) drawn.set(figure, drawPlot(figure));
    }
  }
}
// On paper all parts are shown, and their plots are drawn, as wide as the paper.
const paper = on => () => {
  document.documentElement.classList.toggle("paper", on);
  drawVisible(on);
};
addEventListener("beforeprint", paper(true));
addEventListener("afterprint", paper(false));
let waiting = false;
for (const type of ["scroll", "resize"]) addEventListener(type, () => {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => { waiting = false; drawVisible(); });
}, { passive: true });

// -- mechanisms that move ------------------------------------------------------------------------------------
const SPEEDS = [.01, .02, .05, .1, .2, .5, 1, 2, 5, 10, 20, 50, 100];
for (const figure of all(".motion")) setInMotion(figure, data.motions[figure.dataset.motion]);
function setInMotion(figure, spec) {
  const ts = read(spec.time), outlines = all(".moving", figure), way = figure.querySelector(".way");
  const shapes = spec.shapes.map((shape, i) => ({ ...shape, outline: outlines[i], pose: shape.pose.map(read) }));
  const first = ts[0], last = ts[ts.length - 1], span = last - first || 1;
  const made = (tag, options) => Object.assign(document.createElement(tag), options);
  const play = made("button", { type: "button", className: "play" });
  const slider = made("input", { type: "range", min: first, max: last, step: "any", value: first });
  slider.setAttribute("aria-label", "Time");
  const clock = made("output"), bar = made("div", { className: "bar" });
  const chooser = (label, options, chosen) => {
    const select = made("select"), around = made("label", { textContent: label + " " });
    for (const [value, text] of options) select.append(new Option(text, value, false, value === chosen));
    around.append(select);
    return [around, select];
  };
  const usual = SPEEDS.reduce((a, b) => Math.abs(Math.log(span / b / 10)) < Math.abs(Math.log(span / a / 10)) ? b : a);
  const real = span >= 3 && span <= 30 ? 1 : usual;
  const [speedLabel, speed] = chooser("speed", SPEEDS.filter(v => v >= real / 10 && v <= real * 10).map(v => [v, v + " ×"]), real);
  const names = [...new Set(shapes.filter(s => s.traced).map(s => s.name))];
  const [wayLabel, traced] = chooser("trace", [["", "none"], ...names.map(n => [n, n])], spec.trace);
  bar.append(play, slider, clock, speedLabel, wayLabel);
  figure.insertBefore(bar, figure.querySelector("figcaption"));
  let now = first, running = false, before = 0;
  const between = (values, i, part) => values.length === 1 ? values[0] : values[i] + part * (values[i + 1] - values[i]);
  function row() {
    let low = 0, high = ts.length - 1;
    while (high - low > 1) { const middle = (low + high) >> 1; if (ts[middle] <= now) low = middle; else high = middle; }
    return [low, high > low ? (now - ts[low]) / (ts[high] - ts[low]) : 0];
  }
  function draw() {
    const [i, part] = row();
    for (const { outline, pose } of shapes) {
      const [x, y, phi, along, across] = pose.map(values => values ? between(values, i, part) : spec.mark);
      outline.setAttribute("transform", `translate(${x} ${y}) rotate(${phi * 180 / Math.PI}) scale(${along} ${across})`);
    }
    const point = shapes.find(shape => shape.traced && shape.name === traced.value);
    const rows = point ? Array.from({ length: i + 1 }, (_, k) => [k, 0]).concat([[i, part]]) : [];
    way.setAttribute("d", rows.map(([k, p], n) =>
      `${n ? "L" : "M"}${between(point.pose[0], k, p).toPrecision(5)} ${between(point.pose[1], k, p).toPrecision(5)}`).join(""));
    slider.value = now;
    clock.textContent = now.toFixed(span < 1 ? 3 : 2) + " s";
    slider.setAttribute("aria-valuetext", clock.textContent);
  }
  function run(on) {
    running = on;
    play.textContent = on ? "❚❚" : "▶";
    play.setAttribute("aria-label", on ? "Pause" : "Play");
    if (on) { if (now >= last) now = first; before = performance.now(); requestAnimationFrame(step); }
  }
  function step(instant) {
    if (!running) return;
    now = Math.min(last, now + Math.max(0, instant - before) / 1000 * Number(speed.value));
    before = instant;
    draw();
    if (now >= last) run(false); else requestAnimationFrame(step);
  }
  play.addEventListener("click", () => run(!running));
  slider.addEventListener("input", () => { run(false); now = Number(slider.value); draw(); });
  traced.addEventListener("change", draw);
  run(false);
  draw();
}

let wanted = "";
try { wanted = decodeURIComponent(location.hash.slice(1)); } catch (error) { wanted = ""; }
choose(cards.has(wanted) ? wanted : data.first, false);
document.documentElement.dataset.ready = Math.round(performance.now());
})();
