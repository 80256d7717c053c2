// Reads the PNGs that the report holds: red, green, blue, perhaps alpha, of 8 or 16 bits, not interlaced. A canvas would do, but it
// keeps colours multiplied by alpha and 8 bits only: what stands under the pointer would not be what the file says.

async function decodePng(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const [width, height] = [view.getUint32(16), view.getUint32(20)];
  const [depth, channels] = [bytes[24], bytes[25] === 6 ? 4 : 3];
  const step = (channels * depth) / 8;
  const raw = await inflate(dataChunks(bytes, view));
  unfilter(raw, width * step, height, step);
  return { width, height, max: depth === 8 ? 255 : 65535, data: spread(raw, width, height, channels, depth) };
}

function dataChunks(bytes, view) {
  const chunks = [];
  for (let at = 8; at + 8 <= bytes.length; ) {
    const length = view.getUint32(at);
    if (view.getUint32(at + 4) === 0x49444154) { chunks.push(bytes.subarray(at + 8, at + 8 + length)); }
    at += 12 + length;
  }
  return chunks;
}

async function inflate(chunks) {
  const stream = new Blob(chunks).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Undoes the filters in place. Each row begins with the number of its filter.
function unfilter(raw, length, height, step) {
  for (let y = 0; y < height; y += 1) {
    const start = y * (length + 1) + 1;
    const above = y > 0 ? start - length - 1 : -1;
    unfilterRow(raw, raw[start - 1], start, above, length, step);
  }
}

function unfilterRow(raw, filter, start, above, length, step) {
  if (filter === 0) { return; }
  for (let i = 0; i < length; i += 1) {
    const left = i >= step ? raw[start + i - step] : 0;
    const up = above >= 0 ? raw[above + i] : 0;
    const corner = above >= 0 && i >= step ? raw[above + i - step] : 0;
    raw[start + i] += predicted(filter, left, up, corner);
  }
}

function predicted(filter, left, up, corner) {
  if (filter === 1) { return left; }
  if (filter === 2) { return up; }
  if (filter === 3) { return (left + up) >> 1; }
  const [toLeft, toUp, toCorner] = [Math.abs(up - corner), Math.abs(left - corner), Math.abs(left + up - 2 * corner)];
  if (toLeft <= toUp && toLeft <= toCorner) { return left; }
  return toUp <= toCorner ? up : corner;
}

// All pixels as four levels.
function spread(raw, width, height, channels, depth) {
  const data = depth === 8 ? new Uint8Array(4 * width * height) : new Uint16Array(4 * width * height);
  const opaque = depth === 8 ? 255 : 65535;
  let [from, to] = [0, 0];
  for (let y = 0; y < height; y += 1) {
    from += 1;
    for (let x = 0; x < width; x += 1, to += 4) {
      for (let c = 0; c < channels; c += 1) {
        data[to + c] = depth === 8 ? raw[from] : (raw[from] << 8) | raw[from + 1];
        from += depth / 8;
      }
      if (channels === 3) { data[to + 3] = opaque; }
    }
  }
  return data;
}
