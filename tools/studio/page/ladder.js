// The ladder of pictures: the first rung while the hand moves, finer ones when it rests, the last one tile by tile. A new change aborts
// all that is finer than the first rung; the first one is quick and always arrives, so that the picture follows the hand. Changes never
// wait for it: however many come while it is drawn, the next one drawn is that of the newest.
import { api } from "./api.js";

const rest_ms = 250; // the hand rests when nothing has changed for so long
const stage_ms = 800; // a rung that takes longer tells what is being done

export class Ladder {
  constructor(picture, tell) {
    this.picture = picture;
    this.tell = tell; // {rung, rungs, name, halved, without, milliseconds, working, done, stage, fault}
    this.rungs = [];
    this.width = 0; // px that were asked for the last rung
    this.abort = new AbortController();
    this.timer = 0;
    this.first = null; // the signal with which first rungs are being drawn
    this.drawing = null; // … until the newest is there
    this.wanted = 0; // the newest revision
    this.complete = false; // all of the last one is there
    this.stopped = false;
    this.reached = null; // {revision, rung}: what is drawn
    this.drawn = () => {}; // called with the revision of each finished picture but the first, quick one
    this.rest = async () => {}; // called when the hand rests and the first rung is there
  }

  // The last rung has the pixels of its frame, whose shape the rungs tell.
  async read_rungs() {
    for (let attempt = 0; attempt < 2; ++attempt) {
      const width = this.picture.wanted_width();
      if (attempt > 0 && width === this.width) return;
      this.rungs = await api.rungs(width);
      this.width = width;
      this.picture.resize(this.rungs.at(-1));
    }
  }
  // The frame has another size: the last rung is drawn again at that.
  async fit(revision) {
    if (this.rungs.length === 0 || this.picture.wanted_width() === this.width) return;
    const before = this.rungs.at(-1).width;
    if (this.first) return this.read_rungs(); // the last rung is still to come
    this.stop();
    await this.read_rungs();
    if (this.first) return;
    if (this.rungs.at(-1).width !== before) this.complete = false;
    return this.resume(revision);
  }

  stop() {
    this.stopped = true;
    clearTimeout(this.timer);
    this.abort.abort();
    this.abort = new AbortController();
  }

  // A change is on its way: what is finer than the first rung is out of date.
  stop_finer() {
    if (!this.first) this.stop();
  }

  // What was stopped goes on: the change was refused, or something else had to come first.
  resume(revision) {
    if (this.complete || !this.stopped) return;
    if (this.reached?.revision !== revision) return this.start(revision);
    this.stopped = false;
    return this.climb(revision, this.abort.signal, this.reached.rung + 1);
  }

  // The first rung of a revision; the finer ones follow when the hand rests.
  start(revision) {
    this.wanted = revision;
    if (this.first && !this.first.aborted) return this.drawing;
    this.stop();
    this.stopped = this.complete = false;
    this.drawing = this.follow(this.abort.signal);
    return this.drawing;
  }

  // First rungs, until that of the newest revision is there.
  async follow(signal) {
    this.first = signal;
    let drawn, there;
    do {
      drawn = this.wanted;
      there = this.rungs.length < 2 || (await this.rung(0, drawn, signal));
    } while (drawn !== this.wanted && !signal.aborted);
    if (this.first === signal) this.first = null;
    if (!there || signal.aborted) return;
    this.timer = setTimeout(() => this.climb(drawn, signal), rest_ms);
  }

  async climb(revision, signal, from = 1) {
    try {
      await this.rest(signal);
      for (let rung = from; rung + 1 < this.rungs.length; ++rung) {
        if (!(await this.rung(rung, revision, signal))) return;
      }
      await this.tiles(revision, signal);
    } catch (error) {
      this.failed(error, signal);
      this.waits(error, signal);
    }
  }

  async rung(rung, revision, signal) {
    let waits = setInterval(() => this.read_stage(rung, () => waits !== 0), stage_ms);
    try {
      this.tell({ ...this.about(rung), working: true });
      const started = performance.now();
      const seen = this.picture.view(); // the scene may be another one when the answer comes
      const { blob, milliseconds, halved, without } = await api.picture(rung, revision, this.width, signal);
      await this.picture.show(blob, seen);
      clearInterval(waits);
      waits = 0;
      this.reached = { revision, rung };
      if (rung > 0) this.drawn(revision);
      const about = this.about(rung);
      this.tell({ ...about, halved, without: without ?? about.without, milliseconds: milliseconds || performance.now() - started });
      return true;
    } catch (error) {
      this.failed(error, signal);
      return false;
    } finally {
      clearInterval(waits);
      waits = 0;
    }
  }
  async read_stage(rung, wanted) {
    try {
      const { stage, done } = await api.stage();
      if (stage && wanted()) this.tell({ ...this.about(rung), working: true, stage, done });
    } catch {
      // The picture tells what is wrong.
    }
  }

  async tiles(revision, signal) {
    const last = this.rungs.length - 1;
    const started = performance.now();
    this.tell({ ...this.about(last), working: true, done: 0 });
    let complete = false;
    for await (const record of api.tiles(revision, this.width, signal)) {
      if (signal.aborted) return;
      if (record.blob) await this.picture.tile(record, this.rungs[last]);
      complete = record.done >= 1;
      this.tell({
        ...this.about(last),
        working: !complete,
        done: record.done,
        halved: complete ? 0 : undefined,
        stage: record.stage,
        milliseconds: performance.now() - started,
      });
    }
    this.complete = complete;
    if (complete) this.drawn(revision);
    if (!complete && !signal.aborted)
      this.tell({ fault: { message: "The last rung ended early. Change anything, or press U, to draw again." } });
  }

  // The program draws no last rung while it renders, and tells so by 409: it follows when the rendering is over.
  waits(error, signal) {
    if (error.status !== 409 || signal.aborted) return;
    this.stopped = true;
    this.tell({ ...this.about(this.reached?.rung ?? 0), waiting: true });
  }

  about(rung) {
    return { rung, rungs: this.rungs.length, name: this.rungs[rung].name, without: this.rungs[rung].without ?? [] };
  }

  failed(error, signal) {
    // 409: a newer request has taken its place.
    if (signal.aborted || error.name === "AbortError" || error.status === 409) return;
    this.tell({ fault: error.fault ?? { message: error.message } });
  }
}
