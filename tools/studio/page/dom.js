// Elements of the page, and numbers as people read them.

// An element with its attributes and what is in it; text is never markup. An attribute of undefined, null or false is left out; a function
// is a listener.
export function element(name, attributes = {}, ...children) {
  return filled(document.createElement(name), attributes, children);
}

export function drawing(name, attributes = {}, ...children) {
  return filled(document.createElementNS("http://www.w3.org/2000/svg", name), attributes, children);
}

function filled(made, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === "function") made.addEventListener(key, value);
    else if (value !== undefined && value !== null && value !== false) made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

export const by_id = (id) => document.getElementById(id);

export const clamp = (value, min, max) => Math.max(min, Math.min(max, value));

// A number without the noise of its last bits: as many digits as its step needs.
export function rounded(value, step) {
  const digits = clamp(Math.ceil(-Math.log10(step || 1) - 1e-9), 0, 9);
  return Number(value.toFixed(digits));
}

export function metres(value) {
  if (Math.abs(value) >= 100000) return `${Math.round(value / 1000)} km`;
  if (Math.abs(value) >= 10000) return `${(value / 1000).toFixed(1)} km`;
  return `${Math.round(value)} m`;
}

export function duration(seconds) {
  if (seconds < 60) return `${Math.round(seconds)} s`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`;
  return `${Math.floor(seconds / 3600)} h ${Math.round((seconds % 3600) / 60)} min`;
}

// Moving a pointer held on an element: start(event) returns false to leave it alone; move and end get the event and what start returned.
export function draggable(on, { start, move, end }) {
  let held = null;
  on.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || held) return;
    const what = start(event);
    if (what === false) return;
    event.preventDefault();
    event.stopPropagation();
    on.setPointerCapture(event.pointerId);
    held = { id: event.pointerId, what };
  });
  on.addEventListener("pointermove", (event) => {
    if (held?.id === event.pointerId) move(event, held.what);
  });
  for (const kind of ["pointerup", "pointercancel"])
    on.addEventListener(kind, (event) => {
      if (held?.id !== event.pointerId) return;
      const { what } = held;
      held = null;
      end?.(event, what);
    });
}
