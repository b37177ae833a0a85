// One half of a pair waits for the other: a pixel of the painting for a place of the map, or a place for a pixel. What the fitted view
// proposes as the other half is taken by Enter or by its number.
import { by_id, element, metres } from "./dom.js";
import { sureness } from "./draw.js";

export class Picking extends EventTarget {
  constructor(pairs) {
    super();
    this.pairs = pairs;
    // {pixel, offers: places} or {place, offers: pixels}; null: nothing waits
    this.half = null;
    this.asked = 0;
    by_id("drop-half").addEventListener("click", () => this.drop());
    for (const kind of ["state", "fit"]) pairs.on(kind, () => this.show());
    pairs.on("terrain", () => this.refresh());
    this.show();
  }
  on(kind, listener) {
    this.addEventListener(kind, listener);
  }

  // ---- clicks
  // On the painting.
  async painted(pixel) {
    if (this.half?.place) return this.pair(pixel, this.half.place);
    await this.propose_places(pixel);
  }
  // On the map; a known place within the radius is meant.
  async placed(position, radius) {
    try {
      const place = await this.pairs.place_at(position, radius);
      if (place.pair !== null) {
        this.pairs.select(place.pair);
        if (this.half?.pixel) this.pairs.tell("fault", `${this.pairs.called(place.pair)} has its pair already: drag its ring in the painting.`);
        return;
      }
      if (this.half?.pixel) return this.pair(this.half.pixel, place);
      // What the view hides, or hardly knows, is shown and not offered.
      const sure = place.painted && place.seen && sureness(place.painted.sigma_px, this.pairs.setup.painting.width) > 0.5;
      this.set({ place, offers: place.painted ? [{ ...place.painted, sure }] : [] });
    } catch (error) {
      this.pairs.fail(error);
    }
  }
  async propose_places(pixel) {
    const asked = ++this.asked;
    try {
      const { proposals, ground } = await this.pairs.places_at(pixel);
      if (asked !== this.asked || this.half?.place) return;
      this.set({ pixel, ground, offers: proposals });
    } catch (error) {
      this.pairs.fail(error);
    }
  }
  // A better view may propose better.
  async refresh() {
    if (this.half?.pixel) await this.propose_places(this.half.pixel);
  }
  can_take() {
    return Boolean(this.half?.offers.length > 0 && (this.half.pixel || this.half.offers[0].sure));
  }
  take(number = 0) {
    const offer = this.half?.offers[number];
    if (!offer || !this.can_take()) return;
    return this.half.pixel ? this.pair(this.half.pixel, offer) : this.pair(offer.pixel, this.half.place);
  }
  // The ground under the pixel, where no summit is meant.
  take_ground() {
    if (this.half?.pixel && this.half.ground) return this.pair(this.half.pixel, this.half.ground);
  }
  async pair(pixel, place) {
    const half = this.half;
    this.set(null);
    const taken = await this.pairs.act("add", { pixel, position: place.position, name: place.name });
    if (taken) this.pairs.select(this.pairs.list.length - 1);
    else if (!this.half) this.set(half);
  }
  drop() {
    ++this.asked;
    this.set(null);
  }
  set(half) {
    this.half = half;
    this.pairs.tell("fault", null);
    this.show();
    this.dispatchEvent(new Event("half"));
  }

  // ---- words
  show() {
    const { half, pairs } = this;
    document.body.classList.toggle("half", Boolean(half));
    by_id("drop-half").hidden = !half;
    by_id("prompt").replaceChildren(...this.words());
    const offers = [];
    if (half?.pixel) {
      half.offers.forEach((place, index) => {
        const what = `${Math.round(place.altitude_m)} m · ${place.off_px.toFixed(0)} px away`;
        offers.push(this.offer(index, place.name || "Summit", what, () => this.take(index)));
      });
      if (half.ground) offers.push(this.offer(null, "Ground here", metres(half.ground.altitude_m), () => this.take_ground(), "G"));
    } else if (this.can_take()) {
      offers.push(this.offer(0, "Take the blue cross", "", () => this.take(0)));
    }
    by_id("offers").replaceChildren(...offers);
    document.body.dataset.half = half ? (half.pixel ? "pixel" : "place") : "";
  }
  offer(index, name, what, action, key = index === 0 ? "⏎" : String(index + 1)) {
    return element("button", { type: "button", class: index === 0 ? "first" : undefined, click: action }, name, what ? element("small", {}, what) : null, element("kbd", {}, key));
  }
  words() {
    const { half, pairs } = this;
    const strong = (words) => element("b", {}, words);
    if (!half) return ["Click a summit in the painting, or on the map."];
    if (half.place) {
      const name = half.place.name || `the summit of ${Math.round(half.place.altitude_m)} m`;
      const called = half.place.known === null ? `this place, ${Math.round(half.place.altitude_m)} m,` : name;
      const [offer] = half.offers;
      const where = !offer
        ? ""
        : half.place.seen
          ? ` It should lie within ${Math.max(2, Math.round(2 * offer.sigma_px))} px of the blue cross.`
          : " The view hides it behind other ground.";
      return ["Now click where ", strong(called), " is painted.", where];
    }
    if (half.offers.length > 0) return ["Which one? ", strong("Click it on the map"), ", or take:"];
    const few = pairs.fit.state === "few" || pairs.fit.state === "failed";
    return ["Now click ", strong("the same place on the map"), few ? "." : "; no summit is known to lie there."];
  }
}
