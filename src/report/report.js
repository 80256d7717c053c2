(function () {
  "use strict";

  // Zooms that show every picture pixel as the same number of screen pixels, where it is one or more.
  var STEPS = [0.0625, 0.125, 0.25, 0.5, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64];

  function clamp(x, low, high) {
    return Math.min(Math.max(x, low), high);
  }

  // One scene's pictures: all windows look at the same place of their picture, at the same zoom.
  function Viewer(root) {
    this.root = root;
    this.size = [Number(root.dataset.width), Number(root.dataset.height)];
    this.panes = root.querySelector(".panes");
    this.windows = Array.from(root.querySelectorAll(".window"));
    this.choices = Array.from(root.querySelectorAll(".strip button"));
    this.modes = Array.from(root.querySelectorAll("button[data-mode]"));
    this.status = root.querySelector("output");
    this.split = root.querySelector(".split input");
    this.fitted = true;
    this.zoom = 1;
    this.centre = [this.size[0] / 2, this.size[1] / 2];
    this.pointed = null;
    this.listen();
    this.choose(this.choices[0]);
    this.setSplit(50);
    this.draw();
  }

  Viewer.prototype.visible = function () {
    return this.windows.filter(function (pane) { return pane.clientWidth > 0; });
  };

  // The largest zoom at which the whole picture is seen; a whole number of screen pixels if that is one or more.
  Viewer.prototype.fit = function () {
    var pane = this.visible()[0];
    if (!pane) { return; }
    var device = window.devicePixelRatio || 1;
    var zoom = Math.min(pane.clientWidth / this.size[0], pane.clientHeight / this.size[1]);
    this.zoom = zoom * device >= 1 ? Math.floor(zoom * device + 1e-3) / device : zoom;
    this.centre = [this.size[0] / 2, this.size[1] / 2];
    this.fitted = true;
  };

  Viewer.prototype.draw = function () {
    if (this.fitted) { this.fit(); }
    var zoom = this.zoom, centre = this.centre;
    this.windows.forEach(function (pane) {
      // Halves and products are rounded apart: windows whose sizes were rounded differently still show the same pixels.
      var x = Math.floor(pane.clientWidth / 2) - Math.round(centre[0] * zoom);
      var y = Math.floor(pane.clientHeight / 2) - Math.round(centre[1] * zoom);
      pane.querySelectorAll("img").forEach(function (image) {
        image.style.transform = "translate(" + x + "px, " + y + "px) scale(" + zoom + ")";
      });
    });
    this.describe();
  };

  Viewer.prototype.describe = function () {
    var text = "zoom " + (this.zoom >= 1 ? Math.round(this.zoom * 100) / 100 : this.zoom.toPrecision(2)) + "×";
    if (this.pointed) { text += " · column " + this.pointed[0] + ", row " + this.pointed[1]; }
    this.status.textContent = text;
  };

  // The picture's place under a place of a window, in pixels.
  Viewer.prototype.under = function (pane, event) {
    var box = pane.getBoundingClientRect();
    return [
      this.centre[0] + (event.clientX - box.left - box.width / 2) / this.zoom,
      this.centre[1] + (event.clientY - box.top - box.height / 2) / this.zoom
    ];
  };

  Viewer.prototype.move = function (dx, dy) {
    this.fitted = false;
    this.centre = [clamp(this.centre[0] + dx, 0, this.size[0]), clamp(this.centre[1] + dy, 0, this.size[1])];
    this.draw();
  };

  // Changes the zoom so that a place of the picture stays where it is on the screen.
  Viewer.prototype.zoomTo = function (zoom, anchor) {
    var ratio = this.zoom / zoom;
    var centre = this.centre;
    this.zoom = zoom;
    if (anchor) {
      this.centre = [anchor[0] + (centre[0] - anchor[0]) * ratio, anchor[1] + (centre[1] - anchor[1]) * ratio];
    }
    this.move(0, 0);
  };

  Viewer.prototype.step = function (direction, anchor) {
    var zoom = this.zoom;
    var next = direction > 0
      ? STEPS.find(function (step) { return step > zoom * 1.01; })
      : STEPS.slice().reverse().find(function (step) { return step < zoom * 0.99; });
    if (next) { this.zoomTo(next, anchor); }
  };

  Viewer.prototype.command = function (name, anchor) {
    if (name === "in") { this.step(1, anchor); }
    if (name === "out") { this.step(-1, anchor); }
    if (name === "one") { this.zoomTo(1, anchor); }
    if (name === "fit") { this.fitted = true; this.draw(); }
  };

  Viewer.prototype.setSplit = function (percent) {
    this.split.value = clamp(percent, 0, 100);
    this.panes.style.setProperty("--split", this.split.value + "%");
  };

  Viewer.prototype.setMode = function (mode) {
    this.panes.dataset.mode = mode;
    this.modes.forEach(function (button) { button.setAttribute("aria-pressed", String(button.dataset.mode === mode)); });
    this.draw();
  };

  Viewer.prototype.choose = function (choice) {
    this.choices.forEach(function (other) { other.setAttribute("aria-pressed", String(other === choice)); });
    this.show("capture", 0, choice.dataset.capture, choice.dataset.label);
    this.show("slider", 0, choice.dataset.capture, "left: " + choice.dataset.label + ", right: reference");
    this.show("error", 0, choice.dataset.error, null);
    this.draw();
  };

  Viewer.prototype.show = function (kind, layer, source, caption) {
    var figure = this.panes.querySelector("[data-pane=" + kind + "]");
    var holder = figure.querySelectorAll(".layer")[layer];
    var image = holder.querySelector("img");
    if (!image) {
      image = document.createElement("img");
      image.alt = "";
      image.draggable = false;
      image.width = this.size[0];
      image.height = this.size[1];
      holder.appendChild(image);
    }
    image.hidden = !source;
    if (source && image.getAttribute("src") !== source) { image.setAttribute("src", source); }
    if (caption) {
      figure.querySelector("figcaption").textContent = caption;
      figure.querySelector(".window").setAttribute("aria-label", caption);
    }
  };

  // Capture or reference in one place: the eye sees what moves.
  Viewer.prototype.flip = function () {
    if (this.panes.dataset.mode !== "slider") { this.setMode("slider"); }
    this.setSplit(Number(this.split.value) < 50 ? 100 : 0);
  };

  Viewer.prototype.key = function (event, pane) {
    var far = [pane.clientWidth / 8 / this.zoom, pane.clientHeight / 8 / this.zoom];
    var self = this;
    var actions = {
      "+": function () { self.command("in"); }, "=": function () { self.command("in"); },
      "-": function () { self.command("out"); }, "0": function () { self.command("fit"); },
      "1": function () { self.command("one"); }, " ": function () { self.flip(); },
      ArrowLeft: function () { self.move(-far[0], 0); }, ArrowRight: function () { self.move(far[0], 0); },
      ArrowUp: function () { self.move(0, -far[1]); }, ArrowDown: function () { self.move(0, far[1]); }
    };
    if (actions[event.key] && !event.ctrlKey && !event.metaKey && !event.altKey) {
      event.preventDefault();
      actions[event.key]();
      var slider = this.panes.querySelector("[data-pane=slider] .window");
      if (event.key === " ") { slider.focus({ preventScroll: true }); }
    }
  };

  Viewer.prototype.listen = function () {
    var self = this;
    this.choices.forEach(function (choice) {
      choice.addEventListener("click", function () { self.choose(choice); });
    });
    this.modes.forEach(function (button) {
      button.addEventListener("click", function () { self.setMode(button.dataset.mode); });
    });
    this.root.querySelectorAll("[data-zoom]").forEach(function (button) {
      button.addEventListener("click", function () { self.command(button.dataset.zoom); });
    });
    this.split.addEventListener("input", function () { self.setSplit(Number(self.split.value)); });
    this.windows.forEach(function (pane) { self.listenTo(pane); });
    window.addEventListener("resize", function () { self.draw(); });
  };

  Viewer.prototype.listenTo = function (pane) {
    var self = this;
    var last = null;
    var divider = pane.querySelector(".divider");
    var sliding = false;
    pane.addEventListener("pointerdown", function (event) {
      if (event.button !== 0) { return; }
      sliding = event.target === divider;
      last = [event.clientX, event.clientY];
      pane.setPointerCapture(event.pointerId);
      pane.classList.add("dragged");
    });
    pane.addEventListener("pointermove", function (event) {
      if (last && sliding) {
        var box = pane.getBoundingClientRect();
        self.setSplit(100 * (event.clientX - box.left) / box.width);
      } else if (last) {
        self.move((last[0] - event.clientX) / self.zoom, (last[1] - event.clientY) / self.zoom);
        last = [event.clientX, event.clientY];
      }
      var place = self.under(pane, event).map(Math.floor);
      var inside = place[0] >= 0 && place[1] >= 0 && place[0] < self.size[0] && place[1] < self.size[1];
      self.pointed = inside ? place : null;
      self.describe();
    });
    ["pointerup", "pointercancel", "lostpointercapture"].forEach(function (name) {
      pane.addEventListener(name, function () { last = null; sliding = false; pane.classList.remove("dragged"); });
    });
    pane.addEventListener("pointerleave", function () { self.pointed = null; self.describe(); });
    pane.addEventListener("dblclick", function (event) { self.step(event.shiftKey ? -1 : 1, self.under(pane, event)); });
    // The wheel scrolls the page unless the picture was clicked, or control is held.
    pane.addEventListener("wheel", function (event) {
      if (document.activeElement !== pane && !event.ctrlKey && !event.metaKey) { return; }
      event.preventDefault();
      self.step(event.deltaY < 0 ? 1 : -1, self.under(pane, event));
    }, { passive: false });
    pane.addEventListener("keydown", function (event) { self.key(event, pane); });
  };

  document.querySelectorAll(".viewer").forEach(function (root) { return new Viewer(root); });
})();
