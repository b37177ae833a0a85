"use strict";
// The page around groups.js: the painting with its borders, clicks and keys, the list of groups.

const pieces = decodePieces(segments.pieces, segments.width * segments.height);
const groups = new Groups(segments);
const canvas = document.getElementById("painting");
const image = new Image();
let chosen = -1;
let merging = false;

const classOf = (number) => segments.classes.find((one) => one.number === number);
const say = (text) => { document.getElementById("says").textContent = text; };

function draw() {
  const context = canvas.getContext("2d");
  context.drawImage(image, 0, 0, canvas.width, canvas.height);
  const picture = context.getImageData(0, 0, canvas.width, canvas.height);
  const of = groups.ofPieces();
  const asked = new Set(groups.asked());
  const shown = new Int32Array(canvas.width * canvas.height);
  for (let y = 0; y < canvas.height; ++y) {
    const row = Math.min(Math.floor((y + 0.5) * segments.height / canvas.height), segments.height - 1) * segments.width;
    for (let x = 0; x < canvas.width; ++x) {
      const piece = pieces[row + Math.min(Math.floor((x + 0.5) * segments.width / canvas.width), segments.width - 1)];
      shown[y * canvas.width + x] = piece === 65535 ? -2 : of[piece];
    }
  }
  for (let y = 0; y < canvas.height; ++y)
    for (let x = 0; x < canvas.width; ++x) {
      const at = y * canvas.width + x;
      const here = shown[at];
      const border = (x + 1 < canvas.width && shown[at + 1] !== here) || (y + 1 < canvas.height && shown[at + canvas.width] !== here);
      if (border) picture.data.set([255, 40, 40, 255], 4 * at);
      else if (here === chosen || asked.has(here))
        for (let c = 0; c < 3; ++c)
          picture.data[4 * at + c] = 0.6 * picture.data[4 * at + c] + 0.4 * (here === chosen ? [255, 220, 60] : [40, 90, 255])[c];
    }
  context.putImageData(picture, 0, 0);
}

function addClasses(select, name) {
  for (const one of [...segments.classes, { number: unnamed, name: "not used" }])
    select.add(new Option(one.name, one.number, false, one.number === name));
}

// The question; what was inferred for the first of its groups is chosen.
function ask() {
  const asked = groups.asked();
  const open = groups.openQuestions();
  const select = document.getElementById("shows");
  document.getElementById("asked").textContent = open === 0 ? "Everything has a name." : `What do the blue places show? (${open} to answer)`;
  select.replaceChildren();
  if (open > 0) addClasses(select, groups.groups[asked[0]].name);
  for (const id of ["shows", "answer"]) document.getElementById(id).hidden = open === 0;
}

function list() {
  const of = groups.ofPieces();
  const pixels = new Float64Array(groups.groups.length);
  let all = 0;
  for (const piece of pieces) {
    if (piece === 65535) continue;
    ++pixels[of[piece]];
    ++all;
  }
  const body = document.getElementById("rows");
  body.replaceChildren();
  groups.groups.forEach((group, number) => {
    const row = body.insertRow();
    row.className = number === chosen ? "chosen" : "";
    const swatch = row.insertCell();
    swatch.className = "swatch";
    const known = classOf(group.name);
    swatch.style.background = known ? known.colour : "#000";
    row.insertCell().textContent = `${number + 1}`;
    row.insertCell().textContent = `${(100 * pixels[number] / all).toFixed(1)} %`;
    const select = document.createElement("select");
    addClasses(select, group.name);
    select.addEventListener("change", () => { groups.name(number, Number(select.value)); choose(number); });
    row.insertCell().append(select);
    row.addEventListener("click", (event) => { if (event.target !== select) pick(number); });
  });
  document.getElementById("undo").disabled = groups.now === 0;
  document.getElementById("redo").disabled = groups.now + 1 === groups.states.length;
}

function show() {
  draw();
  list();
  ask();
}
function choose(number) {
  chosen = Math.min(number, groups.groups.length - 1);
  merging = false;
  show();
}
// A group is clicked: it is chosen, or what is chosen takes it in.
function pick(number, take = false) {
  if ((merging || take) && chosen >= 0 && number !== chosen) {
    groups.merge(chosen, number);
    say(`merged; ${groups.groups.length} groups`);
    choose(number < chosen ? chosen - 1 : chosen);
  } else {
    choose(number);
    const known = classOf(groups.groups[number].name);
    say(`group ${number + 1}: ${known ? known.name : "not used"}`);
  }
}

const actions = {
  merge() {
    merging = chosen >= 0;
    say(merging ? "now click what it shall take in" : "choose a group first");
  },
  split() {
    if (chosen < 0) return say("choose a group first");
    say(groups.split(chosen) ? `split; ${groups.groups.length} groups` : "this is a single piece");
    choose(chosen);
  },
  undo() { if (groups.undo()) choose(chosen); },
  redo() { if (groups.redo()) choose(chosen); },
  next() { choose((chosen + 1) % groups.groups.length); },
  previous() { choose((Math.max(chosen, 0) + groups.groups.length - 1) % groups.groups.length); },
  name() {
    const row = document.getElementById("rows").rows[chosen];
    if (row) row.querySelector("select").focus();
  },
};

actions.answer = () => {
  if (groups.answer(Number(document.getElementById("shows").value))) choose(-1);
};

async function maskFile() {
  const colours = [];
  for (const one of segments.classes) colours[one.number] = [1, 3, 5].map((at) => parseInt(one.colour.slice(at, at + 2), 16));
  return palettePng(groups.mask(pieces), segments.width, segments.height, colours);
}
function save(content, type, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}
actions.save = async () => save(await maskFile(), "image/png", segments.mask);
actions.names = () => {
  const nameOf = (number) => classOf(number)?.name ?? "not used";
  save(namesFile(groups, pieces, segments.width, segments.height, nameOf), "application/toml", segments.names);
};

for (const name of ["merge", "split", "undo", "redo", "save", "names", "answer"]) document.getElementById(name).addEventListener("click", actions[name]);
canvas.addEventListener("click", (event) => {
  const box = canvas.getBoundingClientRect();
  const x = Math.floor((event.clientX - box.left) / box.width * segments.width);
  const y = Math.floor((event.clientY - box.top) / box.height * segments.height);
  if (x < 0 || y < 0 || x >= segments.width || y >= segments.height) return;
  const piece = pieces[y * segments.width + x];
  if (piece !== 65535) pick(groups.ofPieces()[piece], event.shiftKey);
});
const keys = { m: "merge", s: "split", u: "undo", r: "redo", n: "name", d: "save", Enter: "answer", ArrowRight: "next", ArrowDown: "next", ArrowLeft: "previous", ArrowUp: "previous" };
document.addEventListener("keydown", (event) => {
  const answering = event.target.id === "shows" && event.key === "Enter";
  if (event.target.tagName === "SELECT" && !answering) return;
  if (event.target.tagName === "BUTTON" && event.key === "Enter") return;
  const command = event.ctrlKey || event.metaKey;
  const action = command ? { z: event.shiftKey ? "redo" : "undo", y: "redo" }[event.key.toLowerCase()] : keys[event.key];
  if (!action) return;
  event.preventDefault();
  actions[action]();
});
image.addEventListener("load", show);
image.src = segments.picture;
