// What a page that is loaded again in the same tab goes on with: the open panel, the kept version, whether there were proposals. It belongs
// to one run of the program, whose token is in the address.
const place = (name) => `belvedere ${location.pathname} ${name}`;

export function remember(name, value) {
  try {
    sessionStorage.setItem(place(name), JSON.stringify(value));
  } catch {
    // There is no room, or the browser keeps nothing: the page works without.
  }
}
export function recall(name) {
  try {
    return JSON.parse(sessionStorage.getItem(place(name))) ?? undefined;
  } catch {
    return undefined;
  }
}
