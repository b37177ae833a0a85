"use strict";
// Groups of a painting's pieces as they are merged, split and named, and the mask that comes of it. Knows nothing of the page.

const unnamed = 255;
const sure = 65535; // the question of groups that need none

// Pieces of all pixels from base64: for each run its piece (two bytes, low first) and its length (seven bits a byte, low first).
function decodePieces(text, count) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const pieces = new Uint16Array(count);
  let at = 0;
  for (let i = 0; i < bytes.length;) {
    const piece = bytes[i] | bytes[i + 1] << 8;
    i += 2;
    let length = 0;
    let shift = 0;
    do {
      length += (bytes[i] & 127) * 2 ** shift;
      shift += 7;
    } while (bytes[i++] & 128);
    pieces.fill(piece, at, at + length);
    at += length;
  }
  if (at !== count) throw new Error("the pieces do not fill the painting");
  return pieces;
}

// The state is a list of groups, each the nodes of the tree that it is made of, the number of its class, the question that it belongs to
// and whether a person said what it shows. It is never changed, only followed by another, so that undoing is going back.
class Groups {
  constructor(data) {
    this.data = data;
    this.pieceCount = data.joins.length + 1;
    this.states = [data.groups.map((node, k) => (
      { nodes: [node], name: data.shows[k], question: data.questions[k], said: data.named[k] === 1 }))];
    this.now = 0;
  }
  get groups() { return this.states[this.now]; }

  follow(groups) {
    this.states.length = this.now + 1;
    this.states.push(groups);
    ++this.now;
  }
  undo() { return this.now > 0 && (--this.now, true); }
  redo() { return this.now + 1 < this.states.length && (++this.now, true); }

  // What the second holds goes to the first, which keeps its name.
  merge(first, second) {
    if (first === second) return false;
    const groups = this.groups.slice();
    groups[first] = { ...groups[first], nodes: groups[first].nodes.concat(groups[second].nodes) };
    groups.splice(second, 1);
    this.follow(groups);
    return true;
  }
  // A merged group falls into what was merged, another one into the two that it was joined from last; a single piece stays.
  split(group) {
    let nodes = this.groups[group].nodes;
    if (nodes.length === 1) {
      if (nodes[0] < this.pieceCount) return false;
      nodes = this.data.joins[nodes[0] - this.pieceCount];
    }
    const groups = this.groups.slice();
    const whole = groups[group];
    groups.splice(group, 1, ...nodes.map((node) => ({ ...whole, nodes: [node] })));
    this.follow(groups);
    return true;
  }
  name(group, name) {
    if (this.groups[group].name === name) return false;
    const groups = this.groups.slice();
    groups[group] = { ...groups[group], name, said: true };
    this.follow(groups);
    return true;
  }

  // The numbers of the groups that the first open question is about: those that look alike and that nobody named. Empty: all is said.
  asked() {
    const open = this.groups.filter((group) => !group.said && group.question !== sure).map((group) => group.question);
    const first = Math.min(...open);
    return [...this.groups.keys()].filter((k) => !this.groups[k].said && this.groups[k].question === first && first !== Infinity);
  }
  openQuestions() { return new Set(this.groups.filter((group) => !group.said && group.question !== sure).map((group) => group.question)).size; }
  // One answer for all of them.
  answer(name) {
    const asked = new Set(this.asked());
    if (asked.size === 0) return false;
    this.follow(this.groups.map((group, k) => (asked.has(k) ? { ...group, name, said: true } : group)));
    return true;
  }

  // The group of each piece.
  ofPieces() {
    const of = new Uint16Array(this.pieceCount);
    this.groups.forEach((group, number) => {
      const open = group.nodes.slice();
      while (open.length > 0) {
        const node = open.pop();
        if (node < this.pieceCount) of[node] = number;
        else open.push(...this.data.joins[node - this.pieceCount]);
      }
    });
    return of;
  }
  // The number of each pixel's class; 255 where there is none, which is never copied from.
  mask(pieces) {
    const of = this.ofPieces();
    const groups = this.groups;
    return Uint8Array.from(pieces, (piece) => (piece === 65535 ? unnamed : groups[of[piece]].name));
  }
}

// What was said, as the command reads it: for each node of a named group a place of its largest piece, in TOML.
function namesFile(groups, pieces, width, height, nameOf) {
  const pixels = new Uint32Array(groups.pieceCount);
  for (const piece of pieces) if (piece !== 65535) ++pixels[piece];
  const left = pixels.map((count) => count >> 1);
  const middle = new Int32Array(groups.pieceCount).fill(-1);
  pieces.forEach((piece, at) => { if (piece !== 65535 && middle[piece] < 0 && left[piece]-- === 0) middle[piece] = at; });
  const largest = (node) => {
    if (node < groups.pieceCount) return node;
    const [a, b] = groups.data.joins[node - groups.pieceCount].map(largest);
    return pixels[b] > pixels[a] ? b : a;
  };
  const lines = groups.groups.filter((group) => group.said).flatMap((group) => group.nodes.map((node) => {
    const at = middle[largest(node)];
    const across = ((at % width + 0.5) / width).toFixed(6);
    const down = ((Math.floor(at / width) + 0.5) / height).toFixed(6);
    return `[[named]]\nat = [${across}, ${down}]\nclass = "${nameOf(group.name)}"\n`;
  }));
  return lines.length === 0 ? "named = []\n" : lines.join("");
}

function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = crc >>> 1 ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

function joined(...parts) {
  const out = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    out.set(part, at);
    at += part.length;
  }
  return out;
}

const big = (value) => [value >>> 24, value >>> 16 & 255, value >>> 8 & 255, value & 255];

// RFC 1950 and 1951: a stream of stored blocks, for browsers that cannot pack.
function storedStream(bytes) {
  const most = 65535;
  const parts = [[0x78, 0x01]];
  for (let at = 0; at === 0 || at < bytes.length; at += most) {
    const part = bytes.subarray(at, at + most);
    parts.push([at + most >= bytes.length ? 1 : 0, part.length & 255, part.length >> 8, ~part.length & 255, ~part.length >> 8 & 255], part);
  }
  let a = 1;
  let b = 0;
  for (const byte of bytes) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  return joined(...parts, [b >> 8, b & 255, a >> 8, a & 255]);
}

async function packed(bytes) {
  if (typeof CompressionStream === "undefined") return storedStream(bytes);
  const stream = new Blob([bytes]).stream().pipeThrough(new CompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// A PNG with a palette of 256 colours: the numbers are its indices.
async function palettePng(numbers, width, height, colours) {
  const rows = new Uint8Array((width + 1) * height);
  for (let y = 0; y < height; ++y) rows.set(numbers.subarray(y * width, (y + 1) * width), y * (width + 1) + 1);
  const chunk = (type, bytes) => {
    const body = joined([...type].map((letter) => letter.charCodeAt(0)), bytes);
    return joined(big(bytes.length), body, big(crc32(body)));
  };
  const palette = new Uint8Array(3 * 256);
  colours.forEach((colour, k) => palette.set(colour, 3 * k));
  return joined([137, 80, 78, 71, 13, 10, 26, 10], chunk("IHDR", [...big(width), ...big(height), 8, 3, 0, 0, 0]), chunk("PLTE", palette),
    chunk("IDAT", await packed(rows)), chunk("IEND", []));
}
