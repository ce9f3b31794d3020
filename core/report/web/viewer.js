// SPDX-License-Identifier: MIT
// The report's own script: the image viewer, the thumbnails at its head, tables that sort, the theme.
// All data is in the page: #run says what there is, and script blocks hold arrays of base64 images, one
// for each of a scene's frames (null where there is none). Nothing is fetched.
"use strict";
(() => {

const find = (id) => document.getElementById(id);
const run = JSON.parse(find("run").textContent);
const REFERENCE = -1; // as a source; others are indices of a scene's trials

// ---- images: decoded when they are needed, kept up to a number of bytes

const DECODED_BYTES = 96 * 1024 * 1024;
const blocks = new Map();  // id -> array of base64 texts
const decoded = new Map(); // "id/frame" -> promise of {width, height, data}, oldest first
let decodedBytes = 0;

function block(id) {
    if (!blocks.has(id))
        blocks.set(id, JSON.parse(find(id).textContent));
    return blocks.get(id);
}

async function decode(text) {
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; i++)
        bytes[i] = binary.charCodeAt(i);
    const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/jpeg" }),
        { colorSpaceConversion: "none", premultiplyAlpha: "none" });
    const canvas = document.createElement("canvas");
    canvas.width = bitmap.width;
    canvas.height = bitmap.height;
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(bitmap, 0, 0);
    bitmap.close();
    return context.getImageData(0, 0, canvas.width, canvas.height);
}

// The codes of a frame, RGBA; null where the page does not hold it.
function image(id, frame) {
    const text = id ? block(id)[frame] : null;
    if (!text)
        return Promise.resolve(null);
    const key = `${id}/${frame}`;
    let promise = decoded.get(key);
    decoded.delete(key); // to the end of the order
    if (!promise) {
        promise = decode(text);
        promise.then((data) => {
            decodedBytes += data.data.length;
            for (const [old, other] of decoded) {
                if (decodedBytes <= DECODED_BYTES || old === key)
                    break;
                decoded.delete(old);
                other.then((gone) => { decodedBytes -= gone.data.length; });
            }
        });
    }
    decoded.set(key, promise);
    return promise;
}

// ---- light and colour

// Film stores code = 255 log2(1 + v/v0) / log2(1 + vmax/v0) for each channel.
function radianceTable([v0, vmax]) {
    const table = new Float32Array(256), range = Math.log2(1 + vmax / v0);
    for (let code = 0; code < 256; code++)
        table[code] = v0 * (2 ** (code / 255 * range) - 1);
    return table;
}

const LEVELS = 16384;
const srgb = new Uint8ClampedArray(LEVELS); // IEC 61966-2-1
for (let i = 0; i < LEVELS; i++) {
    const v = i / (LEVELS - 1);
    srgb[i] = Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
}

// "RRGGBB" 256 times
function colourTable(text) {
    const table = new Uint8ClampedArray(768);
    for (let i = 0; i < 768; i++)
        table[i] = parseInt(text.slice(2 * i, 2 * i + 2), 16);
    return table;
}
const magma = colourTable(run.magma), diverging = colourTable(run.signed);

const luminance = (r, g, b) => 0.2126 * r + 0.7152 * g + 0.0722 * b; // Rec.709

// What a source shows in a frame, as tables and codes: radiance of channel c of pixel i is
// table[codes[4 i + c]] + directTable[direct[4 i + c]].
async function lightOf(scene, source, frame, full) {
    const trial = scene.trials[source];
    const id = source === REFERENCE ? scene.films.reference : trial.film && trial.film.indirect;
    const other = source === REFERENCE ? scene.films.directReference : scene.films.direct;
    const [codes, direct] = await Promise.all([image(id, frame), full ? image(other, frame) : null]);
    if (!codes || (full && !direct))
        return null;
    return { width: codes.width, height: codes.height, codes: codes.data, table: scene.table,
             direct: direct && direct.data, directTable: scene.directTable };
}

function radiance(light, i) {
    const at = 4 * i, out = [0, 0, 0];
    for (let c = 0; c < 3; c++)
        out[c] = light.table[light.codes[at + c]] + (light.direct ? light.directTable[light.direct[at + c]] : 0);
    return out;
}

// Reinhard's operator on luminance, c e/(1 + Y e), as the run's previews; or c e, clipped at 1.
function tonemap(light, exposure, reinhard) {
    const { codes, table, direct, directTable } = light;
    const out = new ImageData(light.width, light.height), pixels = out.data;
    for (let at = 0; at < codes.length; at += 4) {
        let r = table[codes[at]], g = table[codes[at + 1]], b = table[codes[at + 2]];
        if (direct) {
            r += directTable[direct[at]];
            g += directTable[direct[at + 1]];
            b += directTable[direct[at + 2]];
        }
        const gain = (LEVELS - 1) * (reinhard ? exposure / (1 + exposure * luminance(r, g, b)) : exposure);
        pixels[at] = srgb[Math.min(LEVELS - 1, Math.round(r * gain))];
        pixels[at + 1] = srgb[Math.min(LEVELS - 1, Math.round(g * gain))];
        pixels[at + 2] = srgb[Math.min(LEVELS - 1, Math.round(b * gain))];
        pixels[at + 3] = 255;
    }
    return out;
}

// Mixes a map over the image; indexOf(i) is 0 to 255 in the table of colours.
function overlay(picture, colours, opacity, indexOf) {
    const pixels = picture.data;
    for (let i = 0, at = 0; at < pixels.length; i++, at += 4) {
        const colour = 3 * indexOf(i);
        for (let c = 0; c < 3; c++)
            pixels[at + c] += opacity * (colours[colour + c] - pixels[at + c]);
    }
}

// Mean over the channels of a - b, -scale to scale as 0 to 255: as the run's contact sheets.
function signedIndex(a, b, scale) {
    return (i) => {
        const x = radiance(a, i), y = radiance(b, i);
        const t = (x[0] - y[0] + x[1] - y[1] + x[2] - y[2]) / 3 / scale;
        return Math.round(127.5 + 127.5 * Math.max(-1, Math.min(1, t)));
    };
}

// ---- the viewer's state

const MAPS = ["none", "flip", "residual", "signed", "difference"];
const view = {
    scene: null, sources: [0, REFERENCE], frame: 0, layout: "split", flipped: false, layer: "indirect",
    tone: "reinhard", stops: 0, map: "none", opacity: 1, split: 0.5,
    scale: 0,                  // CSS pixels a pixel of the image; 0 = fit
    centre: [0, 0],            // point of the image in the middle of a pane
    pixel: null,               // that is read
    shown: [null, null],       // canvases of A and B
    lights: [null, null],
    maps: [{}, {}],            // codes of flip and residual
    playing: 0,
};

const nameOf = (source) => source === REFERENCE ? "reference" : view.scene.trials[source].name;

async function paintSource(side) {
    const scene = view.scene, source = view.sources[side], full = view.layer === "full";
    const light = await lightOf(scene, source, view.frame, full);
    const trial = scene.trials[source], maps = {};
    if (trial && trial.film) {
        maps.flip = await image(trial.film.flip, view.frame);
        maps.residual = await image(trial.film.residual, view.frame);
    }
    return { light, maps };
}

function picture(side, lights, maps, reference) {
    const light = lights[side], other = lights[1 - side];
    if (!light)
        return null;
    const out = tonemap(light, view.scene.exposure * 2 ** view.stops, view.tone === "reinhard");
    const map = maps[side][view.map];
    if (map)
        overlay(out, magma, view.opacity, (i) => map.data[4 * i]);
    else if (view.map === "signed" && reference && view.sources[side] !== REFERENCE)
        overlay(out, diverging, view.opacity, signedIndex(light, reference, view.scene.mean));
    else if (view.map === "difference" && other)
        overlay(out, diverging, view.opacity, signedIndex(lights[0], lights[1], view.scene.mean));
    const canvas = document.createElement("canvas");
    canvas.width = out.width;
    canvas.height = out.height;
    canvas.getContext("2d").putImageData(out, 0, 0);
    return canvas;
}

async function paint() {
    const [a, b, reference] = await Promise.all([paintSource(0), paintSource(1),
        view.map === "signed" ? lightOf(view.scene, REFERENCE, view.frame, view.layer === "full") : null]);
    view.lights = [a.light, b.light];
    view.maps = [a.maps, b.maps];
    view.shown = [0, 1].map((side) => picture(side, view.lights, view.maps, reference));
}

// One painting at a time; what changes meanwhile is painted when it is done.
let busy = false, again = false;
async function refresh() {
    stage.dataset.state = "busy";
    again = true;
    if (busy)
        return;
    busy = true;
    while (again) {
        again = false;
        await paint();
        draw();
    }
    busy = false;
    stage.dataset.state = "ready";
}

// ---- the stage

const stage = find("stage"), canvas = find("canvas"), divider = find("divider");
const GAP = 8; // CSS pixels between two panes

// Size of the images; null where there are none.
function imageSize() {
    const shown = view.shown[0] || view.shown[1];
    return shown ? [shown.width, shown.height] : null;
}

// The panes as {left, width, side}; side 0 is A.
function panes() {
    const width = stage.clientWidth;
    if (view.layout !== "pair")
        return [{ left: 0, width, side: view.layout === "flip" && view.flipped ? 1 : 0 }];
    const half = (width - GAP) / 2;
    return [{ left: 0, width: half, side: 0 }, { left: half + GAP, width: half, side: 1 }];
}

const fitScale = ([width, height]) => Math.min(panes()[0].width / width, stageHeight([width, height]) / height);
const stageHeight = ([width, height]) => Math.round(Math.min(0.74 * innerHeight, panes()[0].width * height / width));
const scaleNow = () => view.scale || fitScale(imageSize());

function drawPane(context, shown, pane, height, from, to) {
    if (!shown)
        return;
    const scale = scaleNow();
    context.save();
    context.beginPath();
    context.rect(pane.left + from, 0, to - from, height);
    context.clip();
    context.imageSmoothingEnabled = scale < 2;
    context.imageSmoothingQuality = "high";
    context.drawImage(shown, pane.left + pane.width / 2 - view.centre[0] * scale, height / 2 - view.centre[1] * scale,
        shown.width * scale, shown.height * scale);
    context.restore();
}

// A frame round the pixel that is read, in every pane.
function drawPixel(context, pane, height) {
    const scale = scaleNow(), side = Math.max(scale, 7);
    const x = pane.left + pane.width / 2 + (view.pixel[0] + 0.5 - view.centre[0]) * scale;
    const y = height / 2 + (view.pixel[1] + 0.5 - view.centre[1]) * scale;
    if (x < pane.left || x > pane.left + pane.width)
        return;
    for (const [colour, grow] of [["#000", 2], ["#fff", 1]]) {
        context.strokeStyle = colour;
        context.lineWidth = 1;
        context.strokeRect(x - side / 2 - grow, y - side / 2 - grow, side + 2 * grow, side + 2 * grow);
    }
}

function draw() {
    const size = imageSize();
    find("message").hidden = !!(view.shown[0] && view.shown[1]);
    find("message").textContent = size ? "" : "The report holds no image of this frame.";
    if (!size)
        return;
    if (!view.scale)
        view.centre = [size[0] / 2, size[1] / 2];
    const height = stageHeight(size), density = devicePixelRatio || 1, width = stage.clientWidth;
    canvas.style.height = `${height}px`;
    canvas.width = Math.round(width * density);
    canvas.height = Math.round(height * density);
    const context = canvas.getContext("2d");
    context.setTransform(density, 0, 0, density, 0, 0);
    for (const pane of panes()) {
        const split = view.layout === "split" ? Math.round(view.split * width) : pane.width;
        drawPane(context, view.shown[pane.side], pane, height, 0, split);
        if (view.layout === "split")
            drawPane(context, view.shown[1], pane, height, split, width);
        if (view.pixel)
            drawPixel(context, pane, height);
    }
    describe();
    read();
}

// Texts and controls round the stage.
function describe() {
    const scale = scaleNow();
    stage.dataset.scale = scale;
    stage.dataset.centre = view.centre.join(" ");
    find("zoom-text").textContent = `${Math.round(100 * scale)} %`;
    divider.hidden = view.layout !== "split";
    divider.style.left = `${100 * view.split}%`;
    divider.setAttribute("aria-valuenow", Math.round(100 * view.split));
    const labels = ["A", "B"].map((letter, side) => `${letter}  ${nameOf(view.sources[side])}`);
    for (const [side, id] of ["label-a", "label-b"].entries()) {
        find(id).textContent = labels[side];
        find(id).hidden = view.layout === "flip" && side !== Number(view.flipped);
    }
    const frames = view.scene.frames;
    find("frame-text").textContent = `frame ${frames[view.frame]} of 0 to ${view.scene.total - 1}`;
    find("frame").value = view.frame;
    find("exposure").value = view.stops;
    const stops = (view.stops < 0 ? "\u2212" : "+") + Math.abs(view.stops).toFixed(2);
    find("exposure-text").textContent = `${stops} EV, \u00d7${number(view.scene.exposure * 2 ** view.stops)}`;
    find("opacity-text").textContent = `${Math.round(100 * view.opacity)} %`;
    find("map").value = view.map;
    find("play").textContent = view.playing ? "\u23f8" : "\u25b6";
    find("play").setAttribute("aria-label", view.playing ? "Pause" : "Play");
    describeScale();
}

function describeScale() {
    const signed = view.map === "signed" || view.map === "difference";
    find("scale").hidden = view.map === "none";
    find("opacity").disabled = view.map === "none";
    const unit = `${number(view.scene.mean)} W/(m\u00b2 sr), the mean of the indirect reference`;
    find("scale-low").textContent = signed ? "\u22121" : "0";
    find("scale-high").textContent = { flip: "1 (HDR-FLIP against the reference)",
        residual: `1 (change of the error since the frame before, in ${unit})`,
        signed: `+1 (minus the reference: red is too bright, in ${unit})`,
        difference: `+1 (red: A is brighter, in ${unit})` }[view.map] || "";
    const ramp = new ImageData(256, 1), table = signed ? diverging : magma;
    for (let i = 0; i < 256; i++)
        ramp.data.set([...table.slice(3 * i, 3 * i + 3), 255], 4 * i);
    find("ramp").getContext("2d").putImageData(ramp, 0, 0);
}

// ---- what a pixel holds

function number(value) {
    if (!Number.isFinite(value))
        return "\u2013";
    const size = Math.abs(value);
    return (size && (size < 1e-4 || size >= 1e6) ? value.toExponential(2) : value.toPrecision(3)).replace("-", "\u2212");
}

function fillRow(id, values) {
    find(id).querySelectorAll("td").forEach((cell, i) => {
        cell.textContent = values && values[i] !== undefined && values[i] !== null ? number(values[i]) : "\u2013";
    });
}

function read() {
    const size = imageSize(), pixel = view.pixel;
    const inside = pixel && size && pixel[0] >= 0 && pixel[1] >= 0 && pixel[0] < size[0] && pixel[1] < size[1];
    find("pixel").textContent = inside ? `pixel ${pixel[0]}, ${pixel[1]}` : "pixel";
    const index = inside ? pixel[1] * size[0] + pixel[0] : 0;
    const rows = view.lights.map((light, side) => {
        if (!inside || !light)
            return null;
        const rgb = radiance(light, index), { flip, residual } = view.maps[side];
        return [...rgb, luminance(...rgb), flip && flip.data[4 * index] / 255, residual && residual.data[4 * index] / 255];
    });
    fillRow("read-a", rows[0]);
    fillRow("read-b", rows[1]);
    fillRow("read-d", rows[0] && rows[1] && rows[0].slice(0, 4).map((value, i) => value - rows[1][i]));
}

// ---- changes

function setSource(side, source) {
    view.sources[side] = source;
    find(side ? "b" : "a").value = source;
    showBeside();
    refresh();
}

function swap() {
    view.sources.reverse();
    find("a").value = view.sources[0];
    find("b").value = view.sources[1];
    showBeside();
    refresh();
}

function setLayout(layout) {
    if (layout === "flip" && view.layout === "flip")
        view.flipped = !view.flipped;
    view.layout = layout;
    check("layout", layout);
    draw();
}

function check(name, value) {
    document.querySelector(`input[name="${name}"][value="${value}"]`).checked = true;
}

function setStops(stops) {
    view.stops = Math.max(-8, Math.min(8, stops));
    refresh();
}

function setFrame(frame) {
    const count = view.scene.frames.length;
    view.frame = (frame + count) % count;
    return refresh();
}

const FRAMES_A_SECOND = 8;
function play() {
    const turn = view.playing ? 0 : Date.now();
    view.playing = turn;
    const step = async () => {
        if (view.playing !== turn || !turn)
            return;
        const start = performance.now();
        await setFrame(view.frame + 1);
        setTimeout(step, Math.max(0, 1000 / FRAMES_A_SECOND - (performance.now() - start)));
    };
    step();
    describe();
}

function setSplit(split) {
    view.split = Math.max(0, Math.min(1, split));
    draw();
}

// Zooms about a point of the stage (CSS pixels from the middle of its pane).
function zoom(factor, x = 0, y = 0) {
    const size = imageSize();
    if (!size)
        return;
    const before = scaleNow(), least = Math.min(1, fitScale(size)) / 2;
    const after = Math.max(least, Math.min(64, before * factor));
    view.centre = [view.centre[0] + x / before - x / after, view.centre[1] + y / before - y / after];
    view.scale = after;
    draw();
}

function fit() {
    view.scale = 0;
    draw();
}

function setMap(map) {
    view.map = map;
    refresh();
}

function movePixel(dx, dy) {
    const size = imageSize();
    if (!size)
        return;
    const from = view.pixel || view.centre;
    view.pixel = [Math.max(0, Math.min(size[0] - 1, Math.floor(from[0]) + dx)),
                  Math.max(0, Math.min(size[1] - 1, Math.floor(from[1]) + dy))];
    draw();
}

// ---- scene and trials

function option(value, text, disabled) {
    const out = new Option(text, value);
    out.disabled = !!disabled;
    return out;
}

function openScene(index) {
    const scene = view.scene = run.scenes[index];
    view.frame = Math.max(0, scene.frames.indexOf(scene.trials[scene.best] ? scene.trials[scene.best].worst : 0));
    view.scale = 0;
    view.pixel = null;
    for (const id of ["a", "b"]) {
        const choices = scene.trials.map((trial, i) =>
            option(i, trial.film ? trial.name : `${trial.name} (not in this report)`, !trial.film));
        find(id).replaceChildren(option(REFERENCE, "reference"), ...choices);
    }
    const first = scene.trials[scene.best] && scene.trials[scene.best].film ? scene.best
                                                                              : scene.trials.findIndex((trial) => trial.film);
    view.sources = [first, REFERENCE];
    find("scene").value = index;
    find("a").value = first;
    find("b").value = REFERENCE;
    find("frame").max = scene.frames.length - 1;
    for (const input of document.querySelectorAll('input[name="layer"][value="full"]'))
        input.disabled = !scene.full;
    const residuals = scene.trials.some((trial) => trial.film && trial.film.residual);
    find("map").querySelector('[value="residual"]').disabled = !residuals;
    if (view.map === "residual" && !residuals)
        view.map = "none";
    if (view.layer === "full" && !scene.full) {
        view.layer = "indirect";
        check("layer", "indirect");
    }
    describePrecision(scene);
    showBeside();
    return refresh();
}

function describePrecision(scene) {
    const step = ([v0, vmax]) => number(100 * (2 ** (Math.log2(1 + vmax / v0) / 255) - 1));
    const one = (kind) => {
        const coding = scene.coding[kind];
        return `${step(coding)} % of v + ${number(coding[0])} (${kind} light, up to ${number(coding[1])})`;
    };
    find("precision").textContent = "Radiance in W/(m\u00b2 sr), of the first seed. The film holds 8 bits a channel on a "
        + `logarithmic scale: one code is ${one("indirect")}${scene.coding.direct ? ` and ${one("direct")}` : ""}, and `
        + "JPEG adds a few codes at edges. Scores are of the full-precision images; the EXR files that the run kept "
        + "have these.";
}

// Temporal profile and flicker map of A and B.
function showBeside() {
    const parts = [];
    for (const [side, source] of view.sources.entries()) {
        const trial = view.scene.trials[source];
        if (!trial || (!trial.profile && !trial.flicker) || (side && source === view.sources[0]))
            continue;
        const pair = element("div", "pair"), heading = element("h4", "", `${"AB"[side]}  ${trial.name}`);
        pair.append(heading);
        const row = view.scene.profileRow === null ? "One row of the image" : `Row ${view.scene.profileRow} of the image`;
        for (const [id, text] of [
            [trial.profile, `${row} over time, downwards: the trial at the left, the reference at the right`],
            [trial.flicker, "Where it flickers: rms over the sequence of the temporal residual"]]) {
            if (!id)
                continue;
            const figure = element("figure"), picture = new Image();
            picture.src = `data:image/png;base64,${block(id)[0]}`;
            picture.alt = text;
            figure.append(picture, element("figcaption", "small", text));
            pair.append(figure);
        }
        parts.push(pair);
    }
    find("beside").replaceChildren(...parts);
    find("beside").parentElement.classList.toggle("alone", !parts.length);
}

function element(name, className, text) {
    const out = document.createElement(name);
    if (className)
        out.className = className;
    if (text)
        out.textContent = text;
    return out;
}

// ---- keys and pointers

const KEYS = {
    f: () => setLayout("flip"), s: () => setLayout("split"), p: () => setLayout("pair"), x: swap,
    e: () => {
        const maps = MAPS.filter((map) => !find("map").querySelector(`[value="${map}"]`).disabled);
        setMap(maps[(maps.indexOf(view.map) + 1) % maps.length]);
    },
    l: () => { if (view.scene.full) choose("layer", view.layer === "full" ? "indirect" : "full"); },
    t: () => choose("tone", view.tone === "linear" ? "reinhard" : "linear"),
    "[": () => setStops(view.stops - 0.5), "]": () => setStops(view.stops + 0.5),
    "+": () => zoom(Math.SQRT2), "=": () => zoom(Math.SQRT2), "-": () => zoom(Math.SQRT1_2), 0: fit,
    " ": play, ArrowLeft: () => setFrame(view.frame - 1), ArrowRight: () => setFrame(view.frame + 1),
    "shift ArrowLeft": () => movePixel(-1, 0), "shift ArrowRight": () => movePixel(1, 0),
    "shift ArrowUp": () => movePixel(0, -1), "shift ArrowDown": () => movePixel(0, 1),
};

function choose(name, value) {
    view[name] = value;
    check(name, value);
    refresh();
}

// Controls keep the keys that they need themselves.
function isTaken(target, key) {
    const own = /^(Arrow|Home|End|Page| |Enter)/.test(key);
    return target.matches("select") || (own && target.matches("input, button, summary"));
}

function onKey(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || isTaken(event.target, event.key))
        return;
    const split = { ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1 }[event.key];
    const plain = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const action = event.target === divider && split && !event.shiftKey
        ? () => setSplit(view.split + split)
        : KEYS[(event.shiftKey && plain.startsWith("Arrow") ? "shift " : "") + plain];
    if (!action)
        return;
    event.preventDefault();
    action();
}

// Point of the stage relative to the middle of its pane, CSS pixels.
function inPane(event) {
    const box = stage.getBoundingClientRect(), x = event.clientX - box.left;
    const pane = panes().find((p) => x < p.left + p.width) || panes()[0];
    return [x - pane.left - pane.width / 2, event.clientY - box.top - canvas.clientHeight / 2];
}

function pixelAt(event) {
    const [x, y] = inPane(event), scale = scaleNow();
    return [Math.floor(view.centre[0] + x / scale), Math.floor(view.centre[1] + y / scale)];
}

function onPan(event) {
    if (!imageSize() || event.button)
        return;
    stage.focus({ preventScroll: true });
    stage.setPointerCapture(event.pointerId);
    stage.classList.add("panning");
    view.scale = scaleNow();
    let from = [event.clientX, event.clientY];
    const move = (now) => {
        view.centre = [view.centre[0] - (now.clientX - from[0]) / view.scale,
                       view.centre[1] - (now.clientY - from[1]) / view.scale];
        from = [now.clientX, now.clientY];
        draw();
    };
    const end = () => {
        stage.classList.remove("panning");
        stage.removeEventListener("pointermove", move);
    };
    stage.addEventListener("pointermove", move);
    stage.addEventListener("pointerup", end, { once: true });
    stage.addEventListener("pointercancel", end, { once: true });
}

function onDivide(event) {
    event.stopPropagation();
    divider.setPointerCapture(event.pointerId);
    const move = (now) => {
        const box = stage.getBoundingClientRect();
        setSplit((now.clientX - box.left) / box.width);
    };
    divider.addEventListener("pointermove", move);
    const end = () => divider.removeEventListener("pointermove", move);
    divider.addEventListener("pointerup", end, { once: true });
    divider.addEventListener("pointercancel", end, { once: true });
}

function onWheel(event) {
    if (document.activeElement !== stage && document.activeElement !== divider && !event.ctrlKey)
        return; // else the page would not scroll past the image
    event.preventDefault();
    zoom(2 ** (-event.deltaY / 240), ...inPane(event));
}

function listen() {
    const on = (id, type, action) => find(id).addEventListener(type, action);
    on("scene", "change", (e) => openScene(Number(e.target.value)));
    on("a", "change", (e) => setSource(0, Number(e.target.value)));
    on("b", "change", (e) => setSource(1, Number(e.target.value)));
    on("swap", "click", swap);
    on("layout", "change", (e) => { view.flipped = false; setLayout(e.target.value); });
    on("layer", "change", (e) => choose("layer", e.target.value));
    on("tone", "change", (e) => choose("tone", e.target.value));
    on("exposure", "input", (e) => setStops(Number(e.target.value)));
    on("exposure", "dblclick", () => setStops(0));
    on("opacity", "input", (e) => { view.opacity = Number(e.target.value); refresh(); });
    on("map", "change", (e) => setMap(e.target.value));
    on("frame", "input", (e) => setFrame(Number(e.target.value)));
    on("play", "click", play);
    on("in", "click", () => zoom(Math.SQRT2));
    on("out", "click", () => zoom(Math.SQRT1_2));
    on("fit", "click", fit);
    on("viewer", "keydown", onKey);
    stage.addEventListener("wheel", onWheel, { passive: false });
    stage.addEventListener("pointerdown", onPan);
    stage.addEventListener("pointermove", (e) => {
        if (imageSize() && e.target !== divider) {
            view.pixel = pixelAt(e);
            draw();
        }
    });
    divider.addEventListener("pointerdown", onDivide);
    new ResizeObserver(draw).observe(stage);
}

function openViewer() {
    const scenes = [...run.scenes.entries()].filter(([, scene]) =>
        scene.films.reference && scene.coding.indirect && scene.trials.some((trial) => trial.film));
    for (const [, scene] of scenes) {
        scene.table = radianceTable(scene.coding.indirect);
        scene.directTable = scene.coding.direct && radianceTable(scene.coding.direct);
        scene.full = scene.directTable && scene.films.direct && scene.films.directReference;
    }
    if (!scenes.length)
        return;
    find("viewer").hidden = false;
    find("scene").replaceChildren(...scenes.map(([index, scene]) => option(index, scene.name)));
    listen();
    openScene(scenes[0][0]);
}

// ---- contact sheets, where there is no film

function openSheets() {
    const scenes = [...run.scenes.entries()].filter(([, scene]) => scene.trials.some((trial) => trial.sheets));
    if (!scenes.length)
        return;
    const trialOf = () => run.scenes[find("sheet-scene").value].trials[find("sheet-trial").value];
    const showFrame = () => {
        const trial = trialOf(), index = find("sheet-frame").value;
        find("sheet").src = `data:image/png;base64,${block(trial.sheets.id)[index]}`;
        find("sheet").alt = `Contact sheet of ${trial.name}, frame ${trial.sheets.frames[index]}`;
    };
    const showTrial = () => {
        find("sheet-frame").replaceChildren(...trialOf().sheets.frames.map((frame, i) => option(i, frame)));
        showFrame();
    };
    const showScene = () => {
        const trials = [...run.scenes[find("sheet-scene").value].trials.entries()].filter(([, trial]) => trial.sheets);
        find("sheet-trial").replaceChildren(...trials.map(([index, trial]) => option(index, trial.name)));
        showTrial();
    };
    find("sheets").hidden = false;
    find("sheet-scene").replaceChildren(...scenes.map(([index, scene]) => option(index, scene.name)));
    find("sheet-scene").addEventListener("change", showScene);
    find("sheet-trial").addEventListener("change", showTrial);
    find("sheet-frame").addEventListener("change", showFrame);
    showScene();
}

// ---- where each method fails: its worst frame's FLIP map, with the window of the largest mean

// The window of a sixth of the image's sides with the largest mean: {x, y, width, height, mean}.
function worstWindow(map) {
    const w = map.width, h = map.height, width = Math.max(1, Math.round(w / 6)), height = Math.max(1, Math.round(h / 6));
    const sums = new Float64Array((w + 1) * (h + 1)); // of all above and to the left
    for (let y = 0; y < h; y++)
        for (let x = 0, row = 0; x < w; x++) {
            row += map.data[4 * (y * w + x)] / 255;
            sums[(y + 1) * (w + 1) + x + 1] = sums[y * (w + 1) + x + 1] + row;
        }
    const best = { mean: -1, width, height };
    for (let y = 0; y + height <= h; y++)
        for (let x = 0; x + width <= w; x++) {
            const low = y * (w + 1) + x, high = low + height * (w + 1);
            const mean = (sums[high + width] - sums[high] - sums[low + width] + sums[low]) / (width * height);
            if (mean > best.mean)
                Object.assign(best, { mean, x, y });
        }
    return best;
}

function placeName(map, window) {
    const third = (from, size, all, names) => names[Math.min(2, Math.floor(3 * (from + size / 2) / all))];
    const row = third(window.y, window.height, map.height, ["top", "middle", "bottom"]);
    const column = third(window.x, window.width, map.width, ["left", "centre", "right"]);
    return row === "middle" && column === "centre" ? "in the middle" : `${row} ${column}`;
}

async function failure(index, source) {
    const scene = run.scenes[index], trial = scene.trials[source];
    const frame = scene.frames.indexOf(trial.worst), map = await image(trial.film && trial.film.flip, frame);
    if (!map)
        return null;
    const canvas = element("canvas"), context = canvas.getContext("2d"), window = worstWindow(map);
    canvas.width = map.width;
    canvas.height = map.height;
    const picture = new ImageData(map.width, map.height);
    picture.data.fill(255);
    overlay(picture, magma, 1, (i) => map.data[4 * i]);
    context.putImageData(picture, 0, 0);
    for (const [colour, share] of [["#000", 1 / 50], ["#fff", 1 / 120]]) { // seen on dark and bright
        context.strokeStyle = colour;
        context.lineWidth = Math.max(1, map.width * share);
        context.strokeRect(window.x, window.y, window.width, window.height);
    }
    const button = element("button"), item = element("li"), text = element("p"), swatch = element("span", "swatch");
    button.type = "button";
    button.title = "Show it in the viewer";
    button.setAttribute("aria-label", `${trial.name}, frame ${trial.worst}: show its FLIP map in the viewer`);
    button.append(canvas);
    button.addEventListener("click", () => showFailure(index, source, frame));
    swatch.style.background = trial.colour;
    text.append(swatch, element("b", "", trial.method), element("br"),
        `frame ${trial.worst}, ${placeName(map, window)}: FLIP ${number(window.mean)} there, ${number(trial.worstFlip)} overall`);
    item.append(button, text);
    return item;
}

async function showFailure(index, source, frame) {
    view.map = "flip";
    view.layout = "pair";
    check("layout", "pair");
    await openScene(index);
    view.frame = frame;
    setSource(0, source);
    setSource(1, REFERENCE);
    find("images").scrollIntoView();
    stage.focus({ preventScroll: true });
}

async function showFailures() {
    for (const list of document.querySelectorAll("ul.fails")) {
        const index = Number(list.dataset.scene);
        for (const source of run.scenes[index].fails) {
            const item = await failure(index, source);
            if (item)
                list.append(item);
        }
        list.previousElementSibling.hidden = !list.children.length;
    }
}

// ---- tables

function sortBy(button) {
    const title = button.closest("th"), body = title.closest("table").tBodies[0];
    const column = [...title.parentElement.children].indexOf(title);
    const down = title.getAttribute("aria-sort") === "ascending";
    for (const other of title.parentElement.children)
        other.removeAttribute("aria-sort");
    title.setAttribute("aria-sort", down ? "descending" : "ascending");
    const rows = [...body.rows], sign = down ? -1 : 1;
    const key = (row) => row.cells[column].dataset.key;
    rows.sort((a, b) => {
        const x = key(a), y = key(b);
        if (column === 0)
            return sign * a.cells[0].textContent.localeCompare(b.cells[0].textContent);
        if (x === undefined || y === undefined)
            return (x === undefined) - (y === undefined); // what is not there stays last
        return sign * (Number(x) - Number(y));
    });
    body.append(...rows);
}

function openTables() {
    for (const button of document.querySelectorAll(".results thead button"))
        button.addEventListener("click", () => sortBy(button));
    if (!document.querySelector(".results .interval"))
        return;
    find("interval-switch").hidden = false;
    find("intervals").addEventListener("change", (e) => document.body.classList.toggle("no-intervals", !e.target.checked));
}

// ---- theme

function openTheme() {
    const themes = ["system", "light", "dark"], button = find("theme");
    const set = (theme) => {
        button.textContent = `Theme: ${theme}`;
        if (theme === "system")
            delete document.documentElement.dataset.theme;
        else
            document.documentElement.dataset.theme = theme;
    };
    let theme = "system";
    try { // a file: page may have no storage
        theme = themes.includes(localStorage.irbenchTheme) ? localStorage.irbenchTheme : theme;
    } catch { /* then it is not remembered */ }
    set(theme);
    button.hidden = false;
    button.addEventListener("click", () => {
        theme = themes[(themes.indexOf(theme) + 1) % themes.length];
        set(theme);
        try {
            localStorage.irbenchTheme = theme;
        } catch { /* likewise */ }
    });
}

openTheme();
openTables();
openViewer();
openSheets();
showFailures();
})();
