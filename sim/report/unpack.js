// SPDX-License-Identifier: Apache-2.0
//
// Meshes out of the data: the reverse of sim/report_pack.c and of pack() in sim/report_mesh.c.
import { unzlibSync } from 'fflate';

function bytesOf(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** {vertices, faces, position, sides, generation, depth, facing, end, corner}: positions 3 a vertex, in object
 *  space; the rest per face, corners in a row. */
export function unpackMesh(data, box) {
  const bytes = unzlibSync(bytesOf(data));
  let at = 0;
  const next = () => {
    let value = 0, shift = 1, byte;
    do {
      byte = bytes[at++];
      value += (byte & 0x7f) * shift;
      shift *= 128;
    } while (byte & 0x80);
    return value;
  };
  const difference = () => {
    const twice = next();
    return twice % 2 ? -(twice + 1) / 2 : twice / 2;
  };
  const vertices = next(), faces = next();
  const position = new Float32Array(3 * vertices);
  for (let axis = 0; axis < 3; axis++) {
    const side = (box[3 + axis] - box[axis]) / 16383;
    for (let v = 0, value = 0; v < vertices; v++) {
      value += difference();
      position[3 * v + axis] = box[axis] + value * side;
    }
  }
  const column = () => bytes.subarray(at, (at += faces));
  const sides = column(), generation = column(), depth = column(), both = column();
  let corners = 0;
  for (const count of sides) corners += count;
  const corner = new Uint32Array(corners);
  for (let i = 0, used = 0; i < corners; i++) {
    const back = next();
    corner[i] = used - back;
    if (!back) used++;
  }
  return { vertices, faces, position, sides, generation, depth, facing: both.map((b) => b & 3), end: both.map((b) => b >> 2), corner };
}
