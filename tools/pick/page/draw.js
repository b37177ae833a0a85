// What is drawn over the painting and over the map: rings of pairs, known places, what is proposed, and the terrain's lines.

export const colours = { kept: "#7fd18b", doubt: "#f0a94b", wrong: "#ff6b5e", "": "#e9e9e9", half: "#ffd24a", offer: "#7cc4ff", handle: "#d9a3ff" };
const dark = "#101418";

// A ring with a dark edge, so that it shows on any ground.
export function ring(context, [x, y], radius, colour, { dash = [], dot = true, width = 2 } = {}) {
  context.save();
  context.setLineDash(dash);
  for (const [stroke, line] of [
    [dark, width + 2],
    [colour, width],
  ]) {
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.strokeStyle = stroke;
    context.globalAlpha = stroke === dark ? (dash.length > 0 ? 0.3 : 0.65) : 1;
    context.lineWidth = line;
    context.stroke();
  }
  context.globalAlpha = 1;
  if (dot) {
    context.beginPath();
    context.arc(x, y, 1.4, 0, 2 * Math.PI);
    context.fillStyle = colour;
    context.fill();
  }
  context.restore();
}

export function cross(context, [x, y], colour) {
  for (const [stroke, line] of [
    [dark, 4],
    [colour, 2],
  ]) {
    context.beginPath();
    for (const [dx, dy] of [
      [1, 0],
      [-1, 0],
      [0, 1],
      [0, -1],
    ]) {
      context.moveTo(x + 4 * dx, y + 4 * dy);
      context.lineTo(x + 13 * dx, y + 13 * dy);
    }
    context.strokeStyle = stroke;
    context.lineWidth = line;
    context.stroke();
  }
}

export function square(context, [x, y], size, colour) {
  context.fillStyle = colour;
  context.strokeStyle = dark;
  context.lineWidth = 1.5;
  context.fillRect(x - size, y - size, 2 * size, 2 * size);
  context.strokeRect(x - size, y - size, 2 * size, 2 * size);
}

export function line(context, from, to, colour, width = 1.5) {
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.strokeStyle = dark;
  context.globalAlpha = 0.6;
  context.lineWidth = width + 2;
  context.stroke();
  context.globalAlpha = 1;
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.stroke();
}

export function triangle(context, [x, y], size, fill, edge = dark) {
  context.beginPath();
  context.moveTo(x, y - size);
  context.lineTo(x + 0.9 * size, y + 0.6 * size);
  context.lineTo(x - 0.9 * size, y + 0.6 * size);
  context.closePath();
  context.fillStyle = fill;
  context.strokeStyle = edge;
  context.lineWidth = 1;
  context.fill();
  context.stroke();
}

export function text(context, words, [x, y], { ink = "#fff", halo = "#000c", size = 12, weight = 400, align = "left" } = {}) {
  context.font = `${weight} ${size}px system-ui, sans-serif`;
  context.textAlign = align;
  context.textBaseline = "middle";
  context.lineJoin = "round";
  context.lineWidth = 3;
  context.strokeStyle = halo;
  context.strokeText(words, x, y);
  context.fillStyle = ink;
  context.fillText(words, x, y);
}

// A number in a disc: proposals to choose from.
export function badge(context, [x, y], words, colour) {
  context.beginPath();
  context.arc(x, y, 9, 0, 2 * Math.PI);
  context.fillStyle = colour;
  context.strokeStyle = dark;
  context.lineWidth = 1.5;
  context.fill();
  context.stroke();
  context.font = "600 11px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillStyle = dark;
  context.fillText(words, x, y + 0.5);
}

// Where words may stand without covering each other: true and taken, or false.
export class Room {
  constructor() {
    this.boxes = [];
  }
  take(x0, y0, x1, y1) {
    if (this.boxes.some((box) => box[0] < x1 && x0 < box[2] && box[1] < y1 && y0 < box[3])) return false;
    this.boxes.push([x0, y0, x1, y1]);
    return true;
  }
}

// How surely something is drawn where the view shows it, by its deviation in pixels of a painting 1200 px wide: 1 … 0.
export const sureness = (sigma, width) => Math.max(0, Math.min(1, 1.25 - ((sigma * 1200) / width) / 32));

// Lines in pixels of the picture, those in view: fainter where the view is unsure of them.
export function terrain(context, pane, lines) {
  const [x0, y0] = pane.toPicture(-20, -20);
  const [x1, y1] = pane.toPicture(pane.canvas.clientWidth + 20, pane.canvas.clientHeight + 20);
  context.lineJoin = context.lineCap = "round";
  for (const [edge, ridge, skyline] of [
    [true, 2.6, 3.6],
    [false, 1.1, 1.8],
  ])
    for (const each of lines) {
      const { points } = each;
      if (points[0] > x1 || points.at(-2) < x0) continue;
      let inside = false;
      for (let k = 1; k < points.length && !inside; k += 2) inside = points[k] > y0 && points[k] < y1;
      const sure = sureness(each.sigma_px, pane.width);
      if (!inside || sure < 0.08) continue;
      context.beginPath();
      for (let k = 0; k < points.length; k += 2) context.lineTo(...pane.toPage(points[k], points[k + 1]));
      context.globalAlpha = sure * (edge ? 0.35 : each.skyline ? 0.95 : 0.8);
      context.strokeStyle = edge ? "#000" : each.skyline ? "#ff5a4f" : "#ffe14d";
      context.lineWidth = each.skyline ? skyline : ridge;
      context.stroke();
    }
  context.globalAlpha = 1;
}
