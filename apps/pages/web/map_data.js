// Arrays of a page's data, as apps/pages/packed_integers.h packs them.

// Unpacks to a typed array of `type` (Uint8Array, Int16Array or Int32Array) from `planes` planes.
export async function unpack(text, type, planes) {
  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  const all = new Uint8Array(await new Response(stream).arrayBuffer());
  const count = all.length / planes;
  const out = new type(count);
  for (let i = 0; i < count; ++i) {
    let value = 0;
    for (let p = 0; p < planes; ++p) value |= all[p * count + i] << (8 * p);
    out[i] = value;
  }
  return out;
}

// The states of a row, in the order of RowState (core/view/observation.h).
export const kStates = ['used', 'no sample', 'clipped', 'at the floor', 'mirrors a light', 'in the noise',
                        'outlier', 'at an edge'];
export const kUsed = 0;
export const kClipped = 2;
