// A region of cones and a painting of it by a known view, as files: to work on the page that picks pairs and to test it.
import { writeFile } from "node:fs/promises";
import { join } from "node:path";
import { png } from "./mock_picture.mjs";

export const size = [1200, 550];
const cells = 150;
const cell_m = 200;
const [left, top] = [670000, 5270000]; // EPSG:32632

// Every fourth kilometre a cone of its own height on ground that rises to the north.
const summits = [];
for (let row = 0; row < 6; ++row)
  for (let column = 0; column < 6; ++column)
    summits.push({ x: 22 + 20 * column + ((3 * row) % 5), y: 22 + 20 * row + ((2 * column) % 3), height: 500 + 120 * ((column + 2 * row) % 6) });

function altitude(x, y) {
  let height = 0;
  for (const each of summits) height = Math.max(height, each.height - 110 * Math.hypot(x - each.x, y - each.y));
  return 900 - 2 * y + height;
}
export const position = ({ x, y }) => [left + (x + 0.5) * cell_m, top - (y + 0.5) * cell_m];

// Seen from the south, on a cylinder, 1.5 times as tall.
const eye = { east: left + 15000, north: top - 56000, height: 15500, focal: 1150 };
export function pixel(summit) {
  const [east, north] = position(summit);
  const distance = Math.hypot(east - eye.east, north - eye.north);
  const turn = Math.atan2(east - eye.east, north - eye.north);
  return [600 + eye.focal * turn, 60 - eye.focal * ((1.5 * altitude(summit.x, summit.y) - eye.height) / distance + 0.14)];
}
export const seen = summits.filter((each) => {
  const [x, y] = pixel(each);
  return x > 20 && y > 20 && x < size[0] - 20 && y < size[1] - 20;
});

// UTM to degrees is the program's own: the first pairs are picked on the page.
export async function write_world(folder) {
  const rows = [];
  for (let y = 0; y < cells; ++y) {
    const row = [];
    for (let x = 0; x < cells; ++x) row.push(altitude(x, y).toFixed(1));
    rows.push(row.join(" "));
  }
  const head = `ncols ${cells}\nnrows ${cells}\nxllcorner ${left}\nyllcorner ${top - cells * cell_m}\ncellsize ${cell_m}\nNODATA_value -9999\n`;
  await writeFile(join(folder, "cones.asc"), head + rows.join("\n") + "\n");
  const [width, height] = size;
  const rgb = Buffer.alloc(3 * width * height);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) rgb.set([150 - y / 8, 165 - y / 12, 190 - y / 5], 3 * (y * width + x));
  for (const each of seen) {
    const [x, y] = pixel(each).map(Math.round);
    for (let dy = 0; dy < 14; ++dy)
      for (let dx = -dy; dx <= dy; ++dx)
        if (x + dx >= 0 && x + dx < width && y + dy < height) rgb.set([236, 240, 244], 3 * ((y + dy) * width + x + dx));
  }
  await writeFile(join(folder, "painting.png"), png({ width, height, rgb }));
}
