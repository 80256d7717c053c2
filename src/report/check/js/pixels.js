// The values of a case's pictures come as a script when the case is opened: a page from disk may not read files.

const awaited = new Map();

window.dejagPixels = (source, pictures) => {
  const waiting = awaited.get(source);
  if (waiting) { waiting(pictures); }
};

function loadScript(source) {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    const done = (settle, value) => {
      awaited.delete(source);
      script.remove();
      settle(value);
    };
    awaited.set(source, (pictures) => done(resolve, pictures));
    script.onerror = () => done(reject, new Error(source + " cannot be loaded"));
    script.src = source;
    document.head.append(script);
  });
}

function fromBase64(text) {
  return Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
}

// Expected and actual; what is not at hand is null.
async function loadPixels(source) {
  if (!source) { return [null, null]; }
  const pictures = await loadScript(source);
  const read = (text) => (text ? decodePng(fromBase64(text)) : null);
  const [expected, actual] = await Promise.all([read(pictures.expected), read(pictures.actual)]);
  return [pictures.twins ? actual : expected, actual];
}

// The levels at a place, or null outside.
function levelsAt(picture, [x, y]) {
  if (!picture || x < 0 || y < 0 || x >= picture.width || y >= picture.height) { return null; }
  const start = 4 * (y * picture.width + x);
  return Array.from(picture.data.subarray(start, start + 4));
}

// Actual minus expected, in levels of the finer of the two.
function differenceOf(expected, actual, a, b) {
  const max = Math.max(expected.max, actual.max);
  return a.map((level, c) => (b[c] * max) / actual.max - (level * max) / expected.max);
}

function valuesInWords(expected, actual, place) {
  const [a, b] = [levelsAt(expected, place), levelsAt(actual, place)];
  const word = (levels) => (levels ? "(" + levels.join(", ") + ")" : "none");
  const signed = (x) => (x > 0 ? "+" + x : String(x).replace("-", "−"));
  const difference = a && b ? word(differenceOf(expected, actual, a, b).map(signed)) : "none";
  const maxima = [expected, actual].filter(Boolean).map((picture) => picture.max);
  const scale = maxima.length > 0 ? " of " + Math.max(...maxima) : "";
  return place.join(",") + " expected " + word(a) + " actual " + word(b) + " difference " + difference + scale;
}

function draw(canvas, picture) {
  canvas.hidden = !picture;
  if (!picture) { return; }
  [canvas.width, canvas.height] = [picture.width, picture.height];
  const levels = new Uint8ClampedArray(picture.data.length);
  for (let i = 0; i < levels.length; i += 1) { levels[i] = (picture.data[i] * 255) / picture.max; }
  canvas.getContext("2d").putImageData(new ImageData(levels, picture.width, picture.height), 0, 0);
}

// The size of the differences, amplified, over what both pictures cover. Alpha's is a grey.
function drawDifference(canvas, expected, actual, gain) {
  canvas.hidden = !expected || !actual;
  if (canvas.hidden) { return; }
  const [width, height] = [Math.min(expected.width, actual.width), Math.min(expected.height, actual.height)];
  const levels = new Uint8ClampedArray(4 * width * height);
  const [scaleA, scaleB] = [255 / expected.max, 255 / actual.max];
  for (let y = 0, to = 0; y < height; y += 1) {
    let [a, b] = [4 * y * expected.width, 4 * y * actual.width];
    for (let x = 0; x < width; x += 1, to += 4, a += 4, b += 4) {
      const apart = (c) => gain * Math.abs(scaleA * expected.data[a + c] - scaleB * actual.data[b + c]);
      const alpha = apart(3);
      for (let c = 0; c < 3; c += 1) { levels[to + c] = Math.max(apart(c), alpha); }
      levels[to + 3] = 255;
    }
  }
  [canvas.width, canvas.height] = [width, height];
  canvas.getContext("2d").putImageData(new ImageData(levels, width, height), 0, 0);
}
