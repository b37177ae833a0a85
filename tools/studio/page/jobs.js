// Long work of the program in a dialog with progress, time left and cancel: the picture rendered at full size, and maps fetched for a place.
import { api } from "./api.js";
import { by_id, duration } from "./dom.js";
import { Button_progress, in_words } from "./progress.js";
import { judged } from "./sheet.js";

const look_ms = 700;

// A dialog of the elements NAME-dialog, -start, -cancel, -progress, -says and -fault, opened by NAME; `job` has start(), state() and cancel().
class Job {
  constructor(name, job) {
    Object.assign(this, { name, job });
    this.dialog = this.part("dialog");
    this.label = by_id(name).textContent;
    by_id(name).addEventListener("click", () => this.open());
    this.part("start").addEventListener("click", () => this.start());
    this.part("cancel").addEventListener("click", () => this.cancel());
    this.dialog.addEventListener("close", () => by_id(name).focus());
    this.look(); // a job may be running since before the page was opened
  }
  part(of) {
    return by_id(`${this.name}-${of}`);
  }
  open() {
    this.dialog.showModal();
    this.look();
  }

  async start() {
    this.fault(null);
    try {
      await this.job.start();
    } catch (error) {
      return this.fault(error.fault ?? { message: error.message });
    }
    this.running = true;
    this.look();
  }
  async cancel() {
    this.cancelling = true; // told at once; the program may need a moment
    this.tell_state({ ...this.last, state: "running" });
    try {
      await this.job.cancel();
    } catch (error) {
      this.cancelling = false;
      this.fault(error.fault);
    }
    this.look();
  }

  async look() {
    clearTimeout(this.timer);
    let job;
    try {
      job = await this.job.state();
    } catch (error) {
      if (this.running) this.timer = setTimeout(() => this.look(), look_ms);
      return this.fault(error.fault);
    }
    const was_running = this.running;
    this.running = job.state === "running";
    this.cancelling &&= this.running;
    this.last = job;
    this.part("start").disabled = this.running;
    for (const input of this.dialog.querySelectorAll("input")) input.disabled = this.running;
    this.part("cancel").hidden = !this.running;
    const bar = this.part("progress");
    bar.hidden = !this.running;
    if (job.done > 0) bar.value = job.done;
    else bar.removeAttribute("value"); // how long the step takes is not known
    const share = job.done > 0 ? `${Math.floor(100 * job.done)} %: ` : "";
    const left = job.left_s > 0 ? `, ${in_words(job.left_s)} left` : "";
    const told = {
      running: () => `${share}${job.stage || "working"}${left}; ${duration(job.elapsed_s ?? 0)} so far`,
      done: () => `Done in ${duration(job.elapsed_s ?? 0)}. Written to ${job.folder}.`,
      cancelled: () => `Cancelled. ${this.left}`,
    };
    this.part("says").textContent = told[job.state]?.() ?? "";
    if (job.state === "failed") this.fault(job.error);
    this.tell_state(job);
    this.shown(job, was_running && job.state === "done");
    if (was_running && !this.running) this.ended?.();
    if (this.running) this.timer = setTimeout(() => this.look(), look_ms);
  }
  // On the button that opens the dialog, and on that which cancels.
  tell_state(job) {
    by_id(this.name).textContent = job.state === "running" ? this.working : this.label;
    this.part("cancel").disabled = Boolean(this.cancelling);
  }
  fault(fault) {
    this.part("fault").hidden = !fault;
    this.part("fault").textContent = fault?.message ?? "";
  }
}

export class Rendering extends Job {
  // ended: called when a rendering is over, however it ended.
  constructor(store, status, ended) {
    super("render", {
      start: () => api.render(Number(by_id("render-width").value)),
      state: () => api.job("render"),
      cancel: () => api.job_cancel("render"),
    });
    this.button = new Button_progress(by_id("render"), () => this.cancel());
    Object.assign(this, { store, status, ended, left: "Nothing was left behind." });
    by_id("render-width").addEventListener("input", () => this.size());
  }
  open() {
    const field = by_id("render-width");
    if (!this.running) field.value = this.store.value("output.width") ?? 2400;
    this.size();
    super.open();
  }
  tell_state(job) {
    this.part("cancel").disabled = Boolean(this.cancelling);
    this.button.show(job, this.cancelling);
  }
  size() {
    const width = Number(by_id("render-width").value);
    const [w, h] = [this.store.value("output.width") ?? 2400, this.store.value("output.height") ?? 1100];
    const sheet = this.store.value("output.sheet_width_mm") ?? 1200;
    by_id("render-size").textContent =
      width > 0 ? `${width} × ${Math.round((width * h) / w)} px, ${judged({ width, mm: sheet, dpi: (25.4 * width) / sheet })}` : "";
  }
  shown(job, is_new) {
    by_id("render-page").hidden = job.state !== "done" || !job.page;
    if (job.page) by_id("render-page").href = job.page;
    if (is_new && !this.dialog.open) this.status.say("The picture is rendered.");
  }
}

// Maps of a place, and the scene that is proposed for them.
export class Places extends Job {
  constructor(store, status) {
    super("fetch", {
      start: () => api.fetch(by_id("fetch-place").value, by_id("fetch-size").value, by_id("fetch-cover").checked),
      state: () => api.job("fetch"),
      cancel: () => api.job_cancel("fetch"),
    });
    Object.assign(this, { store, status, working: "Fetching…", left: "What was fetched is not asked for again." });
    by_id("fetch-open").addEventListener("click", () => this.take());
    // Enter in a field fetches; the dialog's form would close it.
    for (const field of [by_id("fetch-place"), by_id("fetch-size")])
      field.addEventListener("keydown", (event) => {
        if (event.key !== "Enter") return;
        event.preventDefault();
        this.start();
      });
  }
  shown(job, is_new) {
    this.text = job.text;
    by_id("fetch-open").hidden = !job.text;
    if (is_new && this.dialog.open) by_id("fetch-open").focus();
    else if (is_new) this.status.say("The maps are fetched.");
  }
  async take() {
    this.dialog.close();
    if (await this.store.act(() => api.text(this.text))) this.status.say("This is the place. Ctrl-Z goes back.");
  }
}
