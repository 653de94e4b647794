"use strict";
// Reads what number_stream.h writes.

async function inflated(base64) {
  const packed = Uint8Array.from(atob(base64), (one) => one.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

class NumberReader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  // NaN: no number.
  series(count, scale) {
    const numbers = new Float64Array(count);
    let before = 0;
    for (let i = 0; i < count; ++i) {
      let code = 0;
      let weight = 1;
      let group;
      do {
        group = this.bytes[this.at++];
        code += (group & 127) * weight;
        weight *= 128;
      } while (group > 127);
      if (code === 0) {
        numbers[i] = NaN;
        continue;
      }
      code -= 1;
      before += code % 2 === 0 ? code / 2 : -(code + 1) / 2;
      numbers[i] = before * scale;
    }
    return numbers;
  }
}
