// The page around the picture: what is pointed at, names, seasons, links to a place, ways of GPX files. `panoramaPage` comes before it.
"use strict";

(() => {
  const page = window.panoramaPage;
  const element = (id) => document.getElementById(id);
  const ground = page.ground ? new Ground(page.ground, page.groundScale) : null;
  const canvas = element("picture");
  const says = element("says");
  const names = element("names");
  let viewer = null;
  let ways = [];

  // ---- what is pointed at ----
  const degrees = (value, plus, minus) => `${Math.abs(value).toFixed(4)}° ${value < 0 ? minus : plus}`;
  function wordsAt(x, y) {
    const at = ground && ground.at(x, y);
    if (!at) return "";
    if (at.sky) return "sky";
    const far = at.distance_m < 10000 ? `${(at.distance_m / 1000).toFixed(1)} km` : `${Math.round(at.distance_m / 1000)} km`;
    const place = at.longitude === undefined ? "" : `${degrees(at.latitude, "N", "S")}, ${degrees(at.longitude, "E", "W")} · `;
    return `${place}${Math.round(at.altitude_m)} m · ${far} away · ${at.kind}`;
  }
  const say = (text) => { says.textContent = text || "\u00a0"; };
  canvas.addEventListener("pointermove", (event) => {
    const box = canvas.getBoundingClientRect();
    say(wordsAt(...viewer.toPicture(event.clientX - box.left, event.clientY - box.top)));
  });
  // By keys: what lies in the middle.
  canvas.addEventListener("keyup", () => say(wordsAt(viewer.x, viewer.y)));

  // ---- names ----
  const marks = (page.labels ? page.labels.features : [])
    .filter((f) => f.properties && f.properties.pixel && f.properties.outcome !== "hidden" && f.properties.outcome !== "outside")
    .map((f) => ({
      name: f.properties.name,
      kind: f.properties.kind || "",
      rank: f.properties.rank || 5,
      altitude_m: f.properties.altitude_file_m || f.properties.altitude_dem_m,
      x: f.properties.pixel[0] * page.labelScale,
      y: f.properties.pixel[1] * page.labelScale,
    }))
    .filter((m) => m.x >= 0 && m.y >= 0 && m.x < page.pictures[0].width && m.y < page.pictures[0].height)
    .sort((a, b) => a.rank - b.rank || (b.altitude_m || 0) - (a.altitude_m || 0));
  for (const mark of marks) {
    mark.button = document.createElement("button");
    mark.button.type = "button";
    mark.button.className = `name ${mark.kind === "summit" ? "summit" : "other"}`;
    mark.button.textContent = mark.name;
    const what = [mark.kind, mark.altitude_m ? `${Math.round(mark.altitude_m)} m` : ""].filter(Boolean).join(", ");
    mark.button.setAttribute("aria-label", what ? `${mark.name}, ${what}` : mark.name);
    mark.button.addEventListener("click", () => {
      viewer.show(mark.x, mark.y, Math.max(viewer.scale, Math.min(1, viewer.leastScale() * 4)));
      say(`${mark.name}${what ? `: ${what}` : ""}${wordsAt(mark.x, mark.y + 2) ? ` · ${wordsAt(mark.x, mark.y + 2)}` : ""}`);
    });
    names.append(mark.button);
    mark.size = null;
  }
  // Names of better rank first; one that would lie over another is not shown at this size.
  function placeNames() {
    const taken = [];
    const shown = element("show-names").checked;
    for (const mark of marks) {
      const [x, y] = viewer.toPage(mark.x, mark.y);
      let fits = shown && x > 0 && y > 16 && x < canvas.clientWidth && y < canvas.clientHeight;
      if (fits) {
        mark.button.hidden = false;
        mark.size = mark.size || [mark.button.offsetWidth, mark.button.offsetHeight];
        const [w, h] = mark.size;
        const box = [x - w / 2, y - h - 5, x + w / 2, y + 2];
        fits = !taken.some((b) => b[0] < box[2] && box[0] < b[2] && b[1] < box[3] && box[1] < b[3]);
        if (fits) {
          taken.push(box);
          mark.button.style.left = `${box[0]}px`;
          mark.button.style.top = `${box[1]}px`;
        }
      }
      mark.button.hidden = !fits;
    }
  }

  // ---- ways ----
  function addWay(name, text) {
    if (!ground || !ground.places) throw new Error("this picture does not say where its ground lies");
    const found = waysOfGpx(text);
    const pieces = found.flatMap((way) => drawnWay(ground, way));
    if (!pieces.length) throw new Error(found.length ? "none of it is seen in this picture" : "holds no track and no route");
    ways.push({ name, pieces });
    viewer.redraw();
    const seen = pieces.filter((p) => p.seen).length;
    say(`${name}: drawn, ${seen} piece${seen === 1 ? "" : "s"} seen; dashes: hidden by ground`);
    element("clear-ways").hidden = false;
  }
  function drawWays(context, v) {
    for (const way of ways)
      for (const [style, width] of [["#ffffffd0", 5], ["#c01830", 2.4]])
        for (const piece of way.pieces) {
          context.beginPath();
          context.setLineDash(piece.seen ? [] : [4, 6]);
          context.strokeStyle = style;
          context.lineWidth = piece.seen ? width : width * 0.6;
          context.lineJoin = context.lineCap = "round";
          piece.points.forEach(([x, y], k) => (k ? context.lineTo(...v.toPage(x, y)) : context.moveTo(...v.toPage(x, y))));
          context.stroke();
        }
    context.setLineDash([]);
  }
  async function takeFiles(files) {
    for (const file of files) {
      try {
        addWay(file.name, await file.text());
      } catch (error) {
        say(`${file.name}: ${error.message}`);
      }
    }
  }
  element("gpx").addEventListener("change", (event) => takeFiles(event.target.files));
  element("clear-ways").addEventListener("click", () => {
    ways = [];
    element("clear-ways").hidden = true;
    viewer.redraw();
  });
  for (const kind of ["dragover", "drop"])
    window.addEventListener(kind, (event) => {
      event.preventDefault();
      if (kind === "drop") takeFiles(event.dataTransfer.files);
    });

  // ---- seasons ----
  const seasons = element("second");
  if (page.pictures.length > 1) {
    page.pictures.forEach((picture, k) => {
      if (k > 0) seasons.add(new Option(`${page.pictures[0].name} | ${picture.name}`, String(k)));
    });
    element("seasons").hidden = false;
  }
  const swipe = element("swipe");
  seasons.addEventListener("change", () => {
    viewer.second = Number(seasons.value);
    swipe.disabled = viewer.second === 0;
    viewer.redraw();
  });
  swipe.addEventListener("input", () => viewer.setSwipe(Number(swipe.value) / 100));

  // ---- links ----
  const hash = () => `#x=${(viewer.x / viewer.width).toFixed(5)}&y=${(viewer.y / viewer.height).toFixed(5)}&z=${(viewer.scale / viewer.leastScale()).toFixed(2)}`;
  function goToHash() {
    const wanted = new URLSearchParams(location.hash.slice(1));
    const [x, y, z] = ["x", "y", "z"].map((key) => Number(wanted.get(key)));
    if (wanted.has("x") && [x, y, z].every(Number.isFinite)) viewer.show(x * viewer.width, y * viewer.height, Math.max(1, z) * viewer.leastScale());
  }
  element("link").addEventListener("click", async () => {
    const address = location.href.split("#")[0] + hash();
    history.replaceState(null, "", hash());
    try {
      await navigator.clipboard.writeText(address);
      say("the link to this place is copied");
    } catch {
      say(`the link to this place: ${address}`);
    }
  });
  window.addEventListener("hashchange", goToHash);

  // ---- together ----
  viewer = new Viewer(canvas, page.pictures, () => {
    if (!viewer) return;
    placeNames();
    swipe.value = String(Math.round(viewer.swipe * 100));
  });
  viewer.overlays.push(drawWays);
  element("in").addEventListener("click", () => viewer.zoom(1.6));
  element("out").addEventListener("click", () => viewer.zoom(1 / 1.6));
  element("home").addEventListener("click", () => viewer.home());
  element("show-names").addEventListener("change", placeNames);
  if (!marks.length) element("names-switch").hidden = true;
  if (!ground || !ground.places) element("gpx-switch").hidden = true;
  placeNames();
  goToHash();
  say(ground ? "Point at the picture: place, altitude, distance. Drag to move, wheel or two fingers to zoom." : "This picture came without guidance.exr: nothing is known of its ground.");
  window.panorama = { viewer, ground, marks, addWay, wordsAt, hash, ways: () => ways };
})();
