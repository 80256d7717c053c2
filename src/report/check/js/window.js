// Where the pictures are looked at: one place and one zoom for all windows, moved by pointer and keys.

// Zooms that show a picture pixel as a whole number of screen pixels, where that is one or more.
const ZOOMS = [1 / 16, 1 / 8, 1 / 4, 1 / 2, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64];

const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

class Sight {
  constructor(windows, onPoint, onSlide) {
    this.windows = windows;
    this.onPoint = onPoint;
    this.onSlide = onSlide;
    this.look([1, 1]);
    windows.forEach((pane) => this.listen(pane));
    new ResizeObserver(() => this.draw()).observe(windows[0]);
  }

  // Begins with pictures of another size.
  look(size) {
    this.size = size;
    this.point = null;
    this.fit();
  }

  fit() {
    const pane = this.windows[0];
    const device = window.devicePixelRatio || 1;
    const zoom = Math.min(pane.clientWidth / this.size[0], pane.clientHeight / this.size[1]) || 1;
    this.zoom = zoom * device >= 1 ? Math.min(Math.floor(zoom * device + 1e-3), 64) / device : zoom;
    this.centre = this.size.map((side) => side / 2);
    this.fitted = true;
    this.draw(true);
  }

  draw(fresh) {
    if (this.fitted && !fresh) { this.fit(); return; }
    for (const pane of this.windows) {
      // Halves and products are rounded apart, so that windows of different sizes show the same pixels.
      const x = Math.floor(pane.clientWidth / 2) - Math.round(this.centre[0] * this.zoom);
      const y = Math.floor(pane.clientHeight / 2) - Math.round(this.centre[1] * this.zoom);
      for (const layer of pane.querySelectorAll("canvas, img")) {
        layer.style.transform = "translate(" + x + "px, " + y + "px) scale(" + this.zoom + ")";
      }
      this.drawCross(pane.querySelector(".cross"), x, y);
    }
  }

  drawCross(cross, x, y) {
    cross.hidden = !this.point;
    if (!this.point) { return; }
    const side = Math.max(this.zoom, 1);
    cross.style.left = x + this.point[0] * this.zoom + "px";
    cross.style.top = y + this.point[1] * this.zoom + "px";
    cross.style.width = cross.style.height = side + "px";
  }

  move(dx, dy) {
    this.fitted = false;
    this.centre = [clamp(this.centre[0] + dx, 0, this.size[0]), clamp(this.centre[1] + dy, 0, this.size[1])];
    this.draw();
  }

  // Changes the zoom so that a place of the picture stays where it is on the screen.
  zoomTo(zoom, anchor) {
    const [ratio, centre] = [this.zoom / zoom, this.centre];
    this.zoom = zoom;
    if (anchor) { this.centre = anchor.map((at, i) => at + (centre[i] - at) * ratio); }
    this.move(0, 0);
  }

  step(direction, anchor) {
    const next = direction > 0 ? ZOOMS.find((zoom) => zoom > this.zoom * 1.01) : ZOOMS.findLast((zoom) => zoom < this.zoom * 0.99);
    if (next) { this.zoomTo(next, anchor); }
  }

  // Looks at a pixel from near.
  goTo(pixel) {
    this.fitted = false;
    this.zoom = Math.max(this.zoom, 16);
    this.centre = pixel.map((at) => at + 0.5);
    this.pointAt(pixel, true);
  }

  pointAt(pixel, byKey) {
    this.point = pixel;
    this.draw();
    this.onPoint(pixel, byKey);
  }

  // Moves the crosshair, which begins in the middle of what is seen.
  movePoint(dx, dy) {
    const from = this.point || this.centre.map(Math.floor);
    this.pointAt([clamp(from[0] + dx, 0, this.size[0] - 1), clamp(from[1] + dy, 0, this.size[1] - 1)], true);
  }

  under(pane, event) {
    const box = pane.getBoundingClientRect();
    const corner = [box.left + pane.clientLeft, box.top + pane.clientTop];
    const middle = [Math.floor(pane.clientWidth / 2), Math.floor(pane.clientHeight / 2)];
    return [event.clientX, event.clientY].map((at, i) => (at - corner[i] - middle[i] + Math.round(this.centre[i] * this.zoom)) / this.zoom);
  }

  listen(pane) {
    let [last, sliding] = [null, false];
    pane.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) { return; }
      [last, sliding] = [[event.clientX, event.clientY], event.target.matches(".divider")];
      pane.setPointerCapture(event.pointerId);
    });
    pane.addEventListener("pointermove", (event) => {
      if (last && sliding) {
        const box = pane.getBoundingClientRect();
        this.onSlide((100 * (event.clientX - box.left)) / box.width);
      } else if (last) {
        this.move((last[0] - event.clientX) / this.zoom, (last[1] - event.clientY) / this.zoom);
        last = [event.clientX, event.clientY];
      }
      this.pointUnder(pane, event);
    });
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) { pane.addEventListener(name, () => { last = null; }); }
    pane.addEventListener("dblclick", (event) => this.step(event.shiftKey ? -1 : 1, this.under(pane, event)));
    pane.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.step(event.deltaY < 0 ? 1 : -1, this.under(pane, event));
    }, { passive: false });
  }

  pointUnder(pane, event) {
    const pixel = this.under(pane, event).map(Math.floor);
    const inside = pixel.every((at, i) => at >= 0 && at < this.size[i]);
    if (inside) { this.pointAt(pixel, false); }
  }
}
