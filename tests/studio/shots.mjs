// Screenshots of the page at three sizes: node tests/studio/shots.mjs FOLDER
import puppeteer from "puppeteer-core";
import { serve } from "./mock_server.mjs";

const folder = process.argv[2] ?? "/tmp";
const server = process.env.BELVEDERE_STUDIO ? null : await serve();
const browser = await puppeteer.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
const page = await browser.newPage();
page.on("console", (message) => console.log("console:", message.text()));
page.on("pageerror", (error) => console.log("error:", error.message));
const only = process.argv[3]?.split(",");
for (const [width, height] of [
  [1280, 720],
  [1920, 1080],
  [1024, 768],
]) {
  await page.setViewport({ width, height, hasTouch: width === 1024 });
  await page.goto(process.env.BELVEDERE_STUDIO ?? server.address);
  await page.waitForFunction(() => document.body.dataset.working === "false", { timeout: 20000 });
  for (const panel of only ??
    (width === 1280 ? ["camera", "sun", "ground", "equalizer", "look", "lights", "text", "output"] : ["camera", "equalizer"])) {
    await page.click(`#tab-${panel}`);
    await new Promise((resolve) => setTimeout(resolve, 250));
    await page.screenshot({ path: `${folder}/studio_${width}_${panel}.png` });
  }
}
await browser.close();
server?.close();
