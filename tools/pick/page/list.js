// The table of pairs below the views: what each says and how far it is off, worst first or as picked.
import { by_id, element } from "./dom.js";

export class List {
  constructor(pairs, bring) {
    this.pairs = pairs;
    this.bring = bring;
    this.worst_first = true;
    this.rows = by_id("rows");
    for (const kind of ["state", "fit"]) pairs.on(kind, () => this.show());
    pairs.on("selected", () => this.show_selected());
    by_id("by-error").addEventListener("click", () => this.sort(true));
    by_id("by-line").addEventListener("click", () => this.sort(false));
    this.rows.addEventListener("focusout", () => setTimeout(() => this.late && this.show()));
    this.show();
  }
  sort(worst_first) {
    this.worst_first = worst_first;
    by_id("by-error").setAttribute("aria-pressed", String(worst_first));
    by_id("by-line").setAttribute("aria-pressed", String(!worst_first));
    this.show();
  }
  // As the report has them: thrown out first, then by deviations.
  order() {
    const { pairs } = this;
    const order = pairs.list.map((_, index) => index);
    if (!this.worst_first || !pairs.fit.findings || pairs.fit.findings.length !== order.length) return order;
    const off = (index) => {
      const finding = pairs.fit.findings[index];
      return (finding.wrong ? 1e6 : 0) + finding.deviations;
    };
    return order.sort((a, b) => off(b) - off(a) || a - b);
  }

  show() {
    const { pairs } = this;
    const none = pairs.list.length === 0;
    by_id("empty").hidden = !none;
    this.rows.parentElement.hidden = none;
    document.body.dataset.revision = String(pairs.state.revision);
    by_id("undo").disabled = !pairs.state.can_undo;
    by_id("redo").disabled = !pairs.state.can_redo;
    by_id("outside").hidden = !pairs.state.outside;
    by_id("count").textContent = none ? "No pairs yet" : `${pairs.list.length} ${pairs.list.length === 1 ? "pair" : "pairs"}`;
    by_id("fit-says").textContent = this.fit_words();
    // A name that is being typed stays; the table follows when it is left.
    this.late = this.rows.contains(document.activeElement) && document.activeElement.matches("input[type=text]");
    if (this.late) return;
    const focused = document.activeElement?.closest?.("tr")?.dataset.index;
    this.rows.parentElement.classList.toggle("old", pairs.fit.of !== pairs.state.revision);
    this.rows.replaceChildren(...this.order().map((index) => this.row(index)));
    if (focused !== undefined) this.rows.querySelector(`tr[data-index="${focused}"]`)?.focus({ preventScroll: true });
    this.show_selected();
  }
  fit_words() {
    const { fit, state, setup } = this.pairs;
    const count = state.pairs.length;
    if (count < setup.min_fitted) return count === 0 ? "" : `${setup.min_fitted - count} more until each side proposes the other`;
    if (fit.of !== state.revision) return "fitting …";
    if (fit.state === "failed") return `no view shows them yet: ${fit.message}`;
    if (fit.state === "rough") return `a rough ${fit.projection} view · ${setup.min_pairs - count} more until they are judged`;
    const wrong = fit.wrong > 0 ? ` · ${fit.wrong} thrown out` : "";
    return `${fit.projection} view · ${fit.others_px.toFixed(1)} px off at the median${wrong} · clicks ± ${fit.sigma_px.toFixed(1)} px`;
  }
  row(index) {
    const { pairs } = this;
    const pair = pairs.list[index];
    const finding = pairs.fit.findings?.[index];
    const standing = finding ? (finding.wrong ? "wrong" : finding.doubted ? "doubt" : "kept") : "";
    const number = (value, digits = 1) => element("td", { class: "num" }, value === undefined ? "" : value.toFixed(digits));
    const name = element("input", {
      type: "text",
      value: pair.name,
      placeholder: `${Math.round(pair.altitude_m)} m`,
      "aria-label": `Name of pair ${index + 1}`,
      spellcheck: "false",
      change: (event) => pairs.act("change", { pair: index, name: event.target.value }),
    });
    const sure = element("input", {
      type: "checkbox",
      checked: pair.sure,
      "aria-label": `Pair ${index + 1} is sure`,
      change: (event) => pairs.act("change", { pair: index, sure: event.target.checked }),
    });
    const remove = element("button", { type: "button", class: "remove", title: "Delete (Del)", "aria-label": `Delete pair ${index + 1}`, click: () => pairs.act("remove", { pair: index }) }, "✕");
    return element(
      "tr",
      {
        tabindex: 0,
        "data-index": index,
        click: (event) => {
          if (event.target.matches("input, button")) return;
          pairs.select(index);
          this.bring(index);
        },
        keydown: (event) => this.key(event, index),
      },
      element("td", { class: "num" }, String(index + 1)),
      element("td", {}, element("i", { class: `verdict ${standing}` }), name),
      number(finding?.others_px),
      number(finding?.residual_px),
      number(finding?.view_px),
      number(finding?.deviations),
      element("td", { class: "words", title: finding?.words }, ...(finding ? [element("b", { class: standing }, finding.verdict), ` – ${finding.words}`] : [])),
      element("td", {}, sure),
      element("td", {}, remove),
    );
  }
  key(event, index) {
    if (event.target !== event.currentTarget) return;
    const rows = [...this.rows.children];
    const at = rows.indexOf(event.currentTarget);
    if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      event.stopPropagation();
      this.pairs.select(index);
      this.bring(index);
    } else if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      event.preventDefault();
      const next = rows[at + (event.key === "ArrowDown" ? 1 : -1)];
      if (!next) return;
      next.focus();
      this.pairs.select(Number(next.dataset.index));
      this.bring(Number(next.dataset.index));
    }
  }
  show_selected() {
    for (const row of this.rows.children) {
      const chosen = Number(row.dataset.index) === this.pairs.selected;
      row.setAttribute("aria-selected", String(chosen));
      if (chosen) row.scrollIntoView({ block: "nearest" });
    }
  }
}
