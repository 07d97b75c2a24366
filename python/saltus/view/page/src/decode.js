// Arrays of the page's data: base64 of deflated bytes, those of equal weight together.

const KINDS = { f4: Float32Array, f8: Float64Array, i4: Int32Array };

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflate(base64) {
  const bytes = bytesOf(base64);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export async function unpack(block) {
  const planes = await inflate(block.data);
  const size = KINDS[block.kind].BYTES_PER_ELEMENT;
  const count = planes.length / size;
  const bytes = new Uint8Array(planes.length);
  for (let plane = 0; plane < size; plane++) {
    for (let i = 0; i < count; i++) bytes[i * size + plane] = planes[plane * count + i];
  }
  return new KINDS[block.kind](bytes.buffer);
}

// Replaces every packed array in the data, however deep, by its typed array.
export async function unpackAll(value) {
  if (Array.isArray(value)) {
    if (value.length && typeof value[0] !== 'object') return value;
    return Promise.all(value.map(unpackAll));
  }
  if (value === null || typeof value !== 'object') return value;
  if ('kind' in value && 'data' in value && 'shape' in value) return unpack(value);
  const entries = Object.entries(value).map(async ([key, each]) => [key, await unpackAll(each)]);
  return Object.fromEntries(await Promise.all(entries));
}
