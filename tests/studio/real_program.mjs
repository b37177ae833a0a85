// The real program with its page in headless Chromium, for tests that need no mock.
import { spawn } from "node:child_process";
import { mkdtemp, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import puppeteer from "puppeteer-core";

export const program_path = process.env.BELVEDERE_PROGRAM;
export const patience = { timeout: Number(process.env.BELVEDERE_PATIENCE_MS ?? 240000) };
export const skip = !program_path && "BELVEDERE_PROGRAM is not set";

export const synthetic = `version = 1
[terrain.synthetic]
width = 800
height = 800
cell_m = 30
[camera]
position = [12000, -6000]
height_m = 5000
look_at = [12000, 12000]
[synthesis]
enabled = false
[output]
width = 1000
height = 460
`;

// A scene file in a folder of its own.
export async function scene_file(text = synthetic) {
  const path = join(await mkdtemp(join(tmpdir(), "studio-")), "hills.toml");
  await writeFile(path, text);
  return path;
}

// {program, browser, page, errors, close()}: belvedere studio with these arguments, and its page once all is drawn.
export async function opened(scene, { width = 1280, height = 720 } = {}) {
  const program = spawn(program_path, ["studio", ...scene, "--headless", "--quiet"], { stdio: ["ignore", "pipe", "inherit"] });
  let said = "";
  for await (const bytes of program.stdout) {
    said += bytes;
    if (said.includes("}\n")) break;
  }
  const { address } = JSON.parse(said);
  const browser = await puppeteer.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
  const page = await browser.newPage();
  const errors = [];
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("dialog", (dialog) => dialog.accept());
  await page.setViewport({ width, height });
  await page.goto(address);
  // The whole ladder once, with all that it keeps in memory.
  await page.waitForFunction(() => document.body.dataset.ready === "true" && document.body.dataset.working === "false", patience);
  const close = async () => {
    await browser.close();
    program.kill("SIGINT");
  };
  return { program, browser, page, errors, close };
}
