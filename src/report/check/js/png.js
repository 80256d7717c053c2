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
  const stride = length + 1;
  for (let start = 1; start < height * stride; start += stride) { unfilterRow(raw, raw[start - 1], start, stride, step); }
}

// What lies outside is 0. There, in the first row and the first pixel, it takes the slow way.
function unfilterRow(raw, filter, start, stride, step) {
  const end = start + stride - 1;
  const inside = start > 1 ? start + step : end;
  for (let i = start; i < inside; i += 1) {
    const left = i >= start + step ? raw[i - step] : 0;
    const up = start > 1 ? raw[i - stride] : 0;
    raw[i] += filter === 4 ? nearest(left, up, 0) : [0, left, up, (left + up) >> 1][filter];
  }
  if (filter === 1) { for (let i = inside; i < end; i += 1) { raw[i] += raw[i - step]; } }
  if (filter === 2) { for (let i = inside; i < end; i += 1) { raw[i] += raw[i - stride]; } }
  if (filter === 3) { for (let i = inside; i < end; i += 1) { raw[i] += (raw[i - step] + raw[i - stride]) >> 1; } }
  if (filter === 4) { for (let i = inside; i < end; i += 1) { raw[i] += nearest(raw[i - step], raw[i - stride], raw[i - stride - step]); } }
}

// Of the three neighbours the one that lies nearest to the plane through them.
function nearest(left, up, corner) {
  const toLeft = Math.abs(up - corner);
  const toUp = Math.abs(left - corner);
  const toCorner = Math.abs(left + up - 2 * corner);
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
