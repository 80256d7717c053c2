// The list: which cases are shown, in what order, which one is opened. All of it stands in the address, so that a link leads back.

const DEFAULTS = { show: "all", find: "", sort: "worst", case: "", view: "side" };

const list = byId("cases");
// As the page was written: the worst first.
const rows = Array.from(list.children);
const idOf = new Map(rows.map((row) => [row, decodeURIComponent(row.dataset.id)]));
const rowOf = new Map(rows.map((row) => [idOf.get(row), row]));
const viewer = new Viewer();
let state = DEFAULTS;

const orders = {
  worst: () => rows,
  flip: () => rows.slice().sort((a, b) => Number(b.dataset.flip ?? -1) - Number(a.dataset.flip ?? -1)),
  manifest: () => rows.slice().sort((a, b) => Number(a.dataset.place) - Number(b.dataset.place))
};

function readAddress() {
  const given = new URLSearchParams(location.hash.slice(1).replaceAll("+", "%2B"));
  const read = Object.fromEntries(Object.keys(DEFAULTS).map((key) => [key, given.get(key) ?? DEFAULTS[key]]));
  if (!Object.hasOwn(orders, read.sort)) { read.sort = DEFAULTS.sort; }
  if (!VIEWS.includes(read.view)) { read.view = DEFAULTS.view; }
  return read;
}

function address(wanted) {
  const parts = Object.keys(DEFAULTS).filter((key) => wanted[key] !== DEFAULTS[key]);
  return "#" + parts.map((key) => key + "=" + encodeURIComponent(wanted[key])).join("&");
}

// Opening a case is a step that the browser's way back undoes; all else is not.
function go(change) {
  const wanted = { ...state, ...change };
  history[wanted.case && !state.case ? "pushState" : "replaceState"](null, "", address(wanted));
  apply(wanted);
}

function matches(row, { show, find }) {
  const outcome = row.dataset.outcome;
  const byOutcome = show === "all" || show === outcome || (show === "not-same" && outcome !== "same");
  return byOutcome && idOf.get(row).toLowerCase().includes(find.toLowerCase());
}

const visible = () => Array.from(list.children).filter((row) => !row.hidden);

function apply(wanted) {
  const before = state;
  state = wanted;
  if (wanted.sort !== before.sort) { list.append(...orders[wanted.sort]()); }
  for (const row of rows) { row.hidden = !matches(row, wanted); }
  byId("shown").textContent = visible().length + " of " + rows.length + " shown";
  byId("sort").value = wanted.sort;
  if (byId("find").value !== wanted.find) { byId("find").value = wanted.find; }
  document.querySelectorAll("[data-show]").forEach((button) => {
    button.setAttribute("aria-pressed", String(button.dataset.show === wanted.show));
  });
  if (wanted.view !== viewer.view) { viewer.setView(wanted.view); }
  applyCase(rowOf.get(wanted.case));
}

function applyCase(row) {
  if (row === viewer.row || (!row && !viewer.row)) { return; }
  if (!row) {
    const last = viewer.row;
    viewer.close();
    focusRow(last);
    return;
  }
  const shown = visible();
  viewer.open(row, shown.indexOf(row) + 1, shown.length);
  byId("one").focus({ preventScroll: true });
}

function focusRow(row) {
  const link = row && !row.hidden ? row.querySelector("h3 a") : null;
  if (link) {
    link.focus({ preventScroll: true });
    row.scrollIntoView({ block: "nearest", behavior: "instant" });
  }
}

// The row that a key starts from: the opened one, or the one that has the focus.
function current() {
  return viewer.row || (document.activeElement && document.activeElement.closest("#cases > li"));
}

function step(by) {
  const shown = visible();
  const at = shown.indexOf(current());
  const next = shown[at < 0 ? 0 : clamp(at + by, 0, shown.length - 1)];
  if (!next) { return; }
  if (viewer.row) { go({ case: idOf.get(next) }); } else { focusRow(next); }
}

function isTyping(target) {
  return target.matches("input:not([type=range]), select");
}

function isControl(target) {
  return target.matches("button, a, input, .scroll");
}

function viewerKey(event) {
  const view = VIEWS[Number(event.key) - 1];
  if (view) { go({ view }); return true; }
  // Space and arrows belong to what has the focus.
  if (isControl(event.target) && (event.key === " " || event.key.startsWith("Arrow"))) { return false; }
  return viewer.key(event);
}

function listKey(event) {
  const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
  if (by && event.target.closest("#cases > li")) { step(by); return true; }
  if (event.key === "/") { byId("find").focus(); return true; }
  return false;
}

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || isTyping(event.target) || byId("help").open) { return; }
  const by = { j: 1, k: -1 }[event.key];
  const done = by ? (step(by), true) : event.key === "?" ? (byId("help").showModal(), true) : viewer.row ? viewerKey(event) : listKey(event);
  if (done) { event.preventDefault(); }
}

function listen() {
  document.querySelectorAll("[data-show]").forEach((button) => {
    button.addEventListener("click", () => go({ show: button.dataset.show }));
  });
  document.querySelectorAll("button[data-view]").forEach((button) => {
    button.addEventListener("click", () => go({ view: button.dataset.view }));
  });
  byId("find").addEventListener("input", (event) => go({ find: event.target.value }));
  byId("sort").addEventListener("change", (event) => go({ sort: event.target.value }));
  byId("keys").addEventListener("click", () => byId("help").showModal());
  byId("previous").addEventListener("click", () => step(-1));
  byId("next").addEventListener("click", () => step(1));
  byId("close").addEventListener("click", () => go({ case: "" }));
  viewer.dialog.addEventListener("close", () => { if (viewer.row && !viewer.dialog.open) { go({ case: "" }); } });
  list.addEventListener("click", (event) => {
    const row = event.target.closest("h3 a, .small") && event.target.closest("#cases > li");
    if (!row || event.ctrlKey || event.metaKey || event.shiftKey) { return; }
    event.preventDefault();
    go({ case: idOf.get(row) });
  });
  document.addEventListener("keydown", onKey);
  // A place within the page, such as the way past the controls, is none of ours.
  window.addEventListener("popstate", () => { if (location.hash === "" || location.hash.includes("=")) { apply(readAddress()); } });
}

listen();
apply(readAddress());
