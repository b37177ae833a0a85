// The real job: renders the scene at full size with progress, time left and cancel, and opens the page that zooms into it.
import { api } from "./api.js";
import { by_id, duration } from "./dom.js";

const look_ms = 700;

export class Jobs {
  constructor(store, status) {
    this.store = store;
    this.status = status;
    this.dialog = by_id("render-dialog");
    by_id("render").addEventListener("click", () => this.open());
    by_id("render-start").addEventListener("click", () => this.start());
    by_id("render-cancel").addEventListener("click", () => this.cancel());
    by_id("render-width").addEventListener("input", () => this.size());
    this.dialog.addEventListener("close", () => by_id("render").focus());
    this.look(); // a job may be running since before the page was opened
  }

  open() {
    const field = by_id("render-width");
    if (!this.running) field.value = this.store.value("output.width") ?? 2400;
    this.size();
    this.dialog.showModal();
    this.look();
  }
  size() {
    const width = Number(by_id("render-width").value);
    const [w, h] = [this.store.value("output.width") ?? 2400, this.store.value("output.height") ?? 1100];
    const sheet = this.store.value("output.sheet_width_mm") ?? 1200;
    by_id("render-size").textContent =
      width > 0 ? `${width} × ${Math.round((width * h) / w)} px, ${Math.round((25.4 * width) / sheet)} dpi on ${sheet} mm` : "";
  }

  async start() {
    this.fault(null);
    try {
      await api.render(Number(by_id("render-width").value));
    } catch (error) {
      return this.fault(error.fault ?? { message: error.message });
    }
    this.running = true;
    this.look();
  }
  async cancel() {
    try {
      await api.render_cancel();
    } catch (error) {
      this.fault(error.fault);
    }
    this.look();
  }

  async look() {
    clearTimeout(this.timer);
    let job;
    try {
      job = await api.render_state();
    } catch (error) {
      return this.fault(error.fault);
    }
    const was_running = this.running;
    this.running = job.state === "running";
    by_id("render-start").disabled = by_id("render-width").disabled = this.running;
    by_id("render-cancel").hidden = !this.running;
    by_id("render-progress").hidden = !this.running;
    if (job.done > 0) by_id("render-progress").value = job.done;
    else by_id("render-progress").removeAttribute("value"); // how long the step takes is not known
    const share = job.done > 0 ? ` ${Math.round(100 * job.done)} %` : "";
    const left = job.left_s > 0 ? `, ${duration(job.left_s)} left of this step` : "";
    const told = {
      running: `${job.stage ?? "working"}${share}${left}; ${duration(job.elapsed_s ?? 0)} so far`,
      done: `Done in ${duration(job.elapsed_s ?? 0)}. Written to ${job.folder}.`,
      cancelled: "Cancelled. Nothing was left behind.",
    };
    by_id("render-says").textContent = told[job.state] ?? "";
    by_id("render-page").hidden = job.state !== "done" || !job.page;
    if (job.page) by_id("render-page").href = job.page;
    if (job.state === "failed") this.fault(typeof job.error === "string" ? { message: job.error } : job.error);
    by_id("render").textContent = this.running ? "Rendering…" : "Render…";
    if (was_running && job.state === "done" && !this.dialog.open) this.status.say("The picture is rendered.");
    if (this.running) this.timer = setTimeout(() => this.look(), look_ms);
  }
  fault(fault) {
    by_id("render-fault").hidden = !fault;
    by_id("render-fault").textContent = fault?.message ?? "";
  }
}
