// An opened case: its pictures in six views, and all that its row knows.

const byId = (id) => document.getElementById(id);
const VIEWS = ["side", "slider", "flip", "blink", "difference", "heat"];
// Two changes a second: far from what harms anybody.
const BLINK_MS = 500;
const HOW_TO_MOVE = "; arrow keys move the picture, plus and minus zoom";

class Viewer {
  constructor() {
    this.dialog = byId("viewer");
    this.panes = byId("panes");
    this.row = null;
    this.pictures = [null, null];
    this.view = "side";
    this.timer = null;
    this.sight = new Sight([byId("one"), byId("two")], (pixel, byKey) => this.tell(pixel, byKey), (percent) => this.slide(percent));
    this.listen();
  }

  listen() {
    this.dialog.querySelectorAll("[data-zoom]").forEach((button) => {
      button.addEventListener("click", () => this.zoom(button.dataset.zoom));
    });
    byId("split").addEventListener("input", (event) => this.slide(Number(event.target.value)));
    byId("flip").addEventListener("click", () => this.flip());
    byId("blink").addEventListener("click", () => this.blink(!this.timer));
    byId("gain").addEventListener("change", () => this.drawDifference());
    byId("heat").addEventListener("load", () => this.sight.draw());
  }

  // Shows a row's case. Its pictures come when they are there, unless another case was opened meanwhile.
  async open(row, place, total) {
    this.row = row;
    this.describe(row, place, total);
    if (!this.dialog.open) { this.dialog.showModal(); }
    this.dialog.scrollTop = 0;
    this.setPictures(null, null);
    byId("heat").removeAttribute("src");
    try {
      const pictures = await loadPixels(row.dataset.pixels);
      if (this.row === row) { this.setPictures(...pictures); }
    } catch (error) {
      if (this.row === row) { byId("values").textContent = "The values cannot be read: " + error.message; }
    }
  }

  close() {
    this.blink(false);
    this.row = null;
    if (this.dialog.open) { this.dialog.close(); }
  }

  describe(row, place, total) {
    const word = row.querySelector(".outcome");
    byId("outcome").className = word.className;
    byId("outcome").textContent = word.textContent;
    byId("name").textContent = row.querySelector("h3 a").textContent;
    const known = Array.from(row.querySelectorAll(".about, .figures, .history, .facts-of > *"), (part) => part.cloneNode(true));
    byId("facts").replaceChildren(...known);
    byId("values").textContent = "";
    this.dialog.querySelector("[data-zoom=worst]").disabled = !row.dataset.worst;
    const where = place > 0 ? "Case " + place + " of " + total : "A case that is filtered out";
    byId("said").textContent = where + ": " + byId("name").textContent + ", " + word.textContent;
  }

  setPictures(expected, actual) {
    this.pictures = [expected, actual];
    this.panes.dataset.ready = String(Boolean(expected || actual));
    draw(byId("expected"), expected);
    draw(byId("actual"), actual);
    const size = (key) => Math.max(...this.pictures.map((picture) => (picture ? picture[key] : 1)));
    const [width, height] = [size("width"), size("height")];
    if (expected || actual) { this.panes.style.setProperty("--aspect", width + " / " + height); }
    this.setView(this.view);
    this.sight.look([width, height]);
  }

  setView(view) {
    this.view = view;
    this.panes.dataset.view = view;
    this.dialog.dataset.view = view;
    this.dialog.querySelectorAll("button[data-view]").forEach((button) => {
      button.setAttribute("aria-pressed", String(button.dataset.view === view));
    });
    // Side by side the actual picture has a window of its own.
    const holder = view === "side" ? byId("two") : byId("one");
    if (byId("over").parentNode !== holder) { holder.insertBefore(byId("over"), holder.querySelector(".divider, .cross")); }
    if (view === "difference") { this.drawDifference(); }
    if (view === "heat") { this.loadHeat(); }
    this.show("expected");
    this.blink(view === "blink" && this.row && !matchMedia("(prefers-reduced-motion: reduce)").matches);
    this.sight.draw();
  }

  drawDifference() {
    drawDifference(byId("difference"), ...this.pictures, Number(byId("gain").value));
  }

  loadHeat() {
    const source = this.row && this.row.dataset.heat;
    byId("heat").hidden = !source;
    if (source) { byId("heat").setAttribute("src", source); }
  }

  // Which picture lies on top, in the views that show one at a time.
  show(side) {
    this.panes.dataset.shown = side;
    this.caption();
  }

  caption() {
    const [expected, actual] = ["expected", "actual"].map((side, i) => side + (this.pictures[i] ? "" : " (not at hand)"));
    const shown = this.panes.dataset.shown === "expected" ? expected : actual;
    const both = this.pictures[0] && this.pictures[1];
    const captions = {
      side: expected, slider: "left: " + expected + ", right: " + actual, flip: shown, blink: shown,
      difference: both ? "size of the difference, channel by channel; black is equal" : "one of the pictures is not at hand",
      heat: this.row && this.row.dataset.heat ? "heat map" : "no heat map was made"
    };
    const [one, two] = this.panes.querySelectorAll("figcaption");
    one.textContent = captions[this.view];
    two.textContent = actual;
    byId("one").setAttribute("aria-label", captions[this.view] + HOW_TO_MOVE);
    byId("two").setAttribute("aria-label", actual + HOW_TO_MOVE);
  }

  flip() {
    this.show(this.panes.dataset.shown === "expected" ? "actual" : "expected");
  }

  blink(on) {
    clearInterval(this.timer);
    this.timer = on ? setInterval(() => this.flip(), BLINK_MS) : null;
    byId("blink").setAttribute("aria-pressed", String(on));
  }

  slide(percent) {
    byId("split").value = String(clamp(percent, 0, 100));
    this.panes.style.setProperty("--split", byId("split").value + "%");
  }

  zoom(how) {
    if (how === "in") { this.sight.step(1); }
    if (how === "out") { this.sight.step(-1); }
    if (how === "one") { this.sight.zoomTo(1); }
    if (how === "fit") { this.sight.fit(); }
    if (how === "worst" && this.row.dataset.worst) { this.sight.goTo(this.row.dataset.worst.split(",").map(Number)); }
  }

  // A pointer's every step would be too much to hear; a key's is asked for.
  tell(pixel, byKey) {
    const words = valuesInWords(...this.pictures, pixel);
    byId("values").textContent = words;
    if (byKey) { byId("said").textContent = words; }
  }

  key(event) {
    const [far, arrow] = [64 / this.sight.zoom, { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key]];
    if (arrow && event.shiftKey) { this.sight.movePoint(...arrow); return true; }
    if (arrow) { this.sight.move(arrow[0] * far, arrow[1] * far); return true; }
    const zoom = { "+": "in", "=": "in", "-": "out", 0: "fit", w: "worst" }[event.key];
    if (zoom) { this.zoom(zoom); return true; }
    if (event.key !== " ") { return false; }
    if (this.view === "flip") { this.flip(); }
    if (this.view === "blink") { this.blink(!this.timer); }
    return true;
  }
}
