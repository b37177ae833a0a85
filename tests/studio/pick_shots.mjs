// The picture of docs/registration.md, and others of the page that picks pairs, from a running program:
//   register_trial --data DATA --region karwendel --scenes 1 --first 3 --draws 1 --sigma 2 --write FOLDER writes a scene and pairs
//   belvedere render FOLDER/karwendel_3.toml … makes the painting
//   belvedere exemplar pick PAINTING DEM --pairs PAIRS --names scenes/karwendel_names.csv --headless says the address
//   BELVEDERE_PICK=ADDRESS node tests/studio/pick_shots.mjs FOLDER [PLACE]
// PLACE is a name; it is clicked in the painting, and on the map.
import puppeteer from "puppeteer-core";

const [folder = "/tmp", name = "Sonnjoch"] = process.argv.slice(2);
const browser = await puppeteer.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
const page = await browser.newPage();
page.on("console", (message) => console.log("console:", message.text()));
page.on("pageerror", (error) => console.log("error:", error.message));
await page.setViewport({ width: 1400, height: 900 });
await page.goto(process.env.BELVEDERE_PICK);
await page.waitForFunction(() => document.body.dataset.ready === "true" && document.body.dataset.fitted === document.body.dataset.revision, { timeout: 60000 });
const rest = () => new Promise((resolve) => setTimeout(resolve, 1000));
const shot = async (what) => {
  await rest();
  await page.screenshot({ path: `${folder}/pick_${what}.png` });
};
// Where the place lies on the page.
const click = async (pane) => {
  const at = await page.evaluate(
    (which, wanted) => {
      const views = window.picking_views;
      const { setup, shown } = views.pairs;
      const place = setup.names.indexOf(wanted);
      const [x, y] = which === "map" ? views.to_map(setup.places[place]) : shown.get(place);
      const box = views[which].canvas.getBoundingClientRect();
      const [px, py] = views[which].toPage(x, y);
      return [px + box.left, py + box.top];
    },
    pane,
    name,
  );
  await page.mouse.click(...at);
};
await shot("pairs");
await click("painting");
await shot("from_painting");
await page.keyboard.press("Escape");
await click("map");
await shot("from_map");
await page.keyboard.press("Escape");
await page.keyboard.press("?");
await shot("help");
await browser.close();
