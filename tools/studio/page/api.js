// The JSON interface of the program. Addresses are relative: they begin with the page's own token.

// What the program refuses; `fault` is its message with the place: {message, where, line, column, key, allowed}.
export class Refused extends Error {
  constructor(status, fault) {
    super(fault.message);
    this.status = status;
    this.fault = fault;
  }
}

// A connection that was idle may be closed just when it is used again: what only reads is asked for once more.
async function answered(address, options, again = options?.method !== "POST") {
  let response;
  try {
    response = await fetch(address, { cache: "no-store", ...options });
  } catch (error) {
    if (error.name === "AbortError") throw error;
    if (again) {
      await new Promise((resolve) => setTimeout(resolve, 300));
      return answered(address, options, false);
    }
    throw new Refused(0, { message: "The program does not answer. Is belvedere still running?" });
  }
  if (response.ok) return response;
  let fault = null;
  try {
    fault = (await response.json()).error;
  } catch {
    // Not JSON: the status says what there is to say.
  }
  if (typeof fault === "string") fault = { message: fault };
  if (fault?.allowed) fault.message += `; allowed: ${fault.allowed}`;
  throw new Refused(response.status, fault ?? { message: `The program answered ${response.status} to ${address.split("?")[0]}.` });
}

export const get = async (address, signal) => (await answered(address, { signal })).json();
export const post = async (address, body = {}) =>
  (await answered(address, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) })).json();

export const api = {
  scene: () => get("api/scene"),
  schema: () => get("api/schema"),
  choices: () => get("api/choices"),
  rungs: (width) => get(`api/rungs?width=${width}`), // of the last one, px
  stage: () => get("api/stage"),
  map: () => get("api/map"),
  names: (revision) => get(`api/names?revision=${revision}`),
  draw: (features, changes, step) => post("api/draw", { features, changes, step }),
  check: (signal) => get("api/check", signal),
  proposals: () => get("api/proposals"),
  set: (changes, step) => post("api/set", { changes, step }),
  text: (text) => post("api/text", { text }),
  act: (name, body) => post(`api/${name}`, body), // undo, redo, save, reload
  render: (width) => post("api/render", { width }),
  fetch: (place, size, cover) => post("api/fetch", { place, size, land_cover: cover ? "yes" : "no" }),
  place: (east, north) => get(`api/place?east=${east.toFixed(2)}&north=${north.toFixed(2)}`),
  painting: (name, painting) => post(`api/${name}`, { painting }), // style, pick
  job: (name) => get(`api/${name}`), // render, fetch, painting
  job_cancel: (name) => post(`api/${name}/cancel`),
  pointer: (x, y, revision, signal) => get(`api/pointer?x=${x.toFixed(5)}&y=${y.toFixed(5)}&revision=${revision}`, signal),
  map_picture: (revision) => `api/map.png?of=${revision}`, // of the newest scene, whatever its revision
  seen: async (revision) => (await answered(`api/seen?revision=${revision}`)).arrayBuffer(),
  thumbnail: (index, turn) => `api/proposals/${index}.jpg?turn=${turn}`,

  // The newest scene with changes, small.
  async look(changes, width, signal) {
    const headers = { "Content-Type": "application/json" };
    return (await answered("api/thumbnail", { method: "POST", headers, body: JSON.stringify({ changes, width }), signal })).blob();
  },

  async picture(rung, revision, width, signal) {
    const response = await answered(`api/picture?rung=${rung}&revision=${revision}&width=${width}`, { signal });
    const without = response.headers.get("X-Belvedere-Without");
    return {
      blob: await response.blob(),
      milliseconds: Number(response.headers.get("X-Belvedere-Milliseconds")),
      halved: Number(response.headers.get("X-Belvedere-Halved") ?? 0),
      without:
        without === null
          ? null
          : without
              .split(",")
              .map((each) => each.trim())
              .filter(Boolean),
    };
  },

  // A rectangle as the print has it, {blob, left, top} in px of the print; x and y are shares of the picture, its centre.
  async loupe(x, y, width, height, revision, signal) {
    const query = `x=${x.toFixed(5)}&y=${y.toFixed(5)}&width=${width}&height=${height}&revision=${revision}`;
    const response = await answered(`api/loupe?${query}`, { signal });
    const [left, top] = ["Left", "Top"].map((name) => Number(response.headers.get(`X-Belvedere-${name}`)));
    return { blob: await response.blob(), left, top };
  },

  // Records of the last rung as they come: {x, y, width, height, done, stage, blob}.
  async *tiles(revision, width, signal) {
    const response = await answered(`api/tiles?revision=${revision}&width=${width}`, { signal });
    const read = reader(response.body.getReader());
    for (;;) {
      const size = await read(4);
      if (!size) return;
      const header = JSON.parse(new TextDecoder().decode(await read(new DataView(size.buffer).getUint32(0))));
      yield { ...header, blob: header.bytes > 0 ? new Blob([await read(header.bytes)], { type: "image/png" }) : null };
    }
  },

  async upload(file) {
    const headers = { "Content-Type": "application/octet-stream" };
    return (await answered(`api/files?name=${encodeURIComponent(file.name)}`, { method: "POST", headers, body: file })).json();
  },
};

// A function that takes exactly so many bytes from a stream; null at its end.
function reader(stream) {
  let rest = new Uint8Array(0);
  return async (bytes) => {
    const parts = [];
    let have = 0;
    while (have < bytes) {
      if (rest.length === 0) {
        const { done, value } = await stream.read();
        if (done) return null;
        rest = value;
        continue;
      }
      const part = rest.subarray(0, bytes - have);
      rest = rest.subarray(part.length);
      parts.push(part);
      have += part.length;
    }
    const whole = new Uint8Array(bytes);
    let at = 0;
    for (const part of parts) {
      whole.set(part, at);
      at += part.length;
    }
    return whole;
  };
}
