// How far a rendering is, in words and on the button that began it; a button beside it cancels without a dialog.
import { element } from "./dom.js";

export function in_words(seconds) {
  const many = (count, word) => `about ${count === 1 ? (word === "hour" ? "an" : "a") : count} ${word}${count === 1 ? "" : "s"}`;
  if (seconds < 45) return seconds < 15 ? "a few seconds" : "less than a minute";
  if (seconds < 3000) return many(Math.max(1, Math.round(seconds / 60)), "minute");
  if (seconds < 5400) return many(1, "hour");
  return many(Math.round(seconds / 1800) / 2, "hour");
}

export class Button_progress {
  constructor(button, cancel) {
    this.button = button;
    this.label = button.textContent;
    this.title = button.title;
    this.cancel = element("button", { type: "button", id: `${button.id}-stop`, hidden: true, click: cancel }, "×");
    this.cancel.title = "Cancel the rendering";
    this.cancel.setAttribute("aria-label", "Cancel the rendering");
    button.after(this.cancel);
  }
  // job: the answer of api/render; cancelling: it was asked to end.
  show({ state, done, left_s, stage }, cancelling) {
    const running = state === "running";
    const share = done > 0 ? ` ${Math.floor(100 * done)} %` : "…";
    this.button.textContent = running ? (cancelling ? "Cancelling…" : `Rendering${share}`) : this.label;
    this.button.title = running ? [stage, left_s > 0 ? `${in_words(left_s)} left` : ""].filter(Boolean).join(", ") : this.title;
    this.button.classList.toggle("running", running);
    this.button.style.setProperty("--done", `${100 * (running ? (done ?? 0) : 0)}%`);
    this.cancel.hidden = !running;
    this.cancel.disabled = Boolean(cancelling);
  }
}
