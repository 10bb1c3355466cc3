/** Decodes PDZ16 depth images; common/image/depth_model.h has the format. */

const LANES = 4;
const CONTEXTS = 48;
const TOTAL_BITS = 10;
const TOTAL = 1 << TOTAL_BITS;
const STATE_MIN = 1 << 15;
const DIRECT = 16;
const DIRECT_BITS = 5;
const TOKENS = 1 + DIRECT + 16 - DIRECT_BITS + 1;
const LEFT_HOLE = 3;
const HEADER_BYTES = 8;

const rawBits = (token: number) => (token <= DIRECT ? 0 : token - DIRECT - 2 + DIRECT_BITS);
const unfold = (folded: number) => ((folded >> 1) ^ -(folded & 1)) & 0xffff;
const order = (a: number, b: number) => 1 + Number(a > b) - Number(a < b);

class Bytes {
  at = 0;
  constructor(readonly data: Uint8Array) {}

  varint(): number {
    let value = 0;
    for (let shift = 0; shift <= 28; shift += 7) {
      if (this.at >= this.data.length) throw new RangeError("a depth image that ends early");
      const byte = this.data[this.at++];
      value += (byte & 0x7f) * 2 ** shift;
      if (byte < 0x80) return value;
    }
    throw new RangeError("a number too long");
  }
}

/** One context: which token lies at each of the TOTAL places, its frequency and where it starts. */
class Table {
  readonly tokenAt = new Uint8Array(TOTAL);
  readonly frequency = new Uint16Array(TOKENS);
  readonly start = new Uint16Array(TOKENS);

  constructor(bytes: Bytes) {
    const used = bytes.varint();
    if (used > TOKENS) throw new RangeError("too many tokens");
    let start = 0;
    for (let token = 0; token < used; ++token) {
      const frequency = bytes.varint();
      if (frequency > TOTAL - start) throw new RangeError("frequencies too large");
      this.frequency[token] = frequency;
      this.start[token] = start;
      this.tokenAt.fill(token, start, start + frequency);
      start += frequency;
    }
    if (used === 0) this.frequency[0] = TOTAL;
    else if (start !== TOTAL) throw new RangeError("frequencies too small");
  }
}

/** Range asymmetric numeral systems; see common/image/rans.h. */
class Coder {
  private state: number;
  private overrun = false;

  constructor(
    private readonly data: Uint8Array,
    private at: number,
    private readonly end: number,
  ) {
    this.state = ((this.word() << 16) | this.word()) & 0x7fffffff;
  }

  token(table: Table): number {
    const place = this.state & (TOTAL - 1);
    const token = table.tokenAt[place];
    this.state = table.frequency[token] * (this.state >>> TOTAL_BITS) + place - table.start[token];
    this.refill();
    return token;
  }

  raw(bits: number): number {
    const value = this.state & ((1 << bits) - 1);
    this.state >>>= bits;
    this.refill();
    return value;
  }

  atEnd(): boolean {
    return this.at === this.end && this.state === STATE_MIN && !this.overrun;
  }

  private refill(): void {
    if (this.state < STATE_MIN) this.state = ((this.state << 16) | this.word()) >>> 0;
  }

  private word(): number {
    if (this.at === this.end) {
      this.overrun = true;
      return 0;
    }
    this.at += 2;
    return this.data[this.at - 2] | (this.data[this.at - 1] << 8);
  }
}

function palette(bytes: Bytes): Uint16Array {
  const values = new Uint16Array(1 << 16);
  const count = bytes.varint();
  if (count > 0xffff) throw new RangeError("a palette too large");
  for (let index = 1, value = 0; index <= count; ++index) {
    const step = bytes.varint();
    value += step;
    if (step === 0 || value > 0xffff) throw new RangeError("a palette out of order");
    values[index] = value;
  }
  return values;
}

function everyValue(): Uint16Array {
  return Uint16Array.from({ length: 1 << 16 }, (_, value) => value);
}

/** One band of rows. `above` and `row` have a margin of one at the left. */
function decodeBand(
  coder: Coder,
  tables: Table[],
  valueOf: Uint16Array,
  out: Uint16Array,
  width: number,
): void {
  let above = new Uint16Array(width + 1);
  let row = new Uint16Array(width + 1);
  for (let first = 0; first < out.length; first += width) {
    const isHole = (u: number) => first === 0 || out[first - width + u] === 0;
    let left = (row[0] = above[1]);
    let leftIsHole = 0;
    for (let u = 0; u < width; ++u) {
      const right = Math.min(u + 1, width - 1);
      const ul = above[u];
      const up = above[u + 1];
      const holes = Number(isHole(u)) + 2 * Number(isHole(right));
      const slopes = 3 * order(ul, up) + order(up, above[right + 1]);
      const aboveClass = 4 * (holes !== 0 ? 8 + holes : slopes);
      const token = coder.token(tables[aboveClass + (order(left, ul) | leftIsHole)]);
      let value = 0;
      if (token !== 0) {
        const bits = rawBits(token);
        const folded = bits === 0 ? token - 1 : (1 << bits) | coder.raw(bits);
        const low = Math.min(left, up);
        const predicted = Math.max(low, Math.min(left + up - low, left + up - ul));
        left = value = (predicted + unfold(folded)) & 0xffff;
      }
      leftIsHole = token === 0 ? LEFT_HOLE : 0;
      row[u + 1] = left;
      out[first + u] = valueOf[value];
    }
    [above, row] = [row, above];
  }
}

/** Throws RangeError if `data` is not one whole image of width x height. */
export function decodePdz16(data: Uint8Array, width: number, height: number): Uint16Array {
  const u16 = (at: number) => data[at] | (data[at + 1] << 8);
  const isOurs = data.length >= HEADER_BYTES && data[0] === 0x50 && data[1] === 0x5a && data[2] === 1;
  if (!isOurs || u16(4) !== width || u16(6) !== height) throw new RangeError("not a PDZ16 image");
  const values = new Uint16Array(width * height);
  const layout = data[3];
  if (layout === 0) {
    if (data.length !== HEADER_BYTES + 2 * values.length) throw new RangeError("a wrong size");
    return values.map((_, i) => u16(HEADER_BYTES + 2 * i));
  }
  if (layout > 2) throw new RangeError("an unknown layout");
  const bytes = new Bytes(data);
  bytes.at = HEADER_BYTES;
  const valueOf = layout === 2 ? palette(bytes) : everyValue();
  const tables = Array.from({ length: CONTEXTS }, () => new Table(bytes));
  const sizes = Array.from({ length: LANES }, () => 2 * bytes.varint());
  let at = bytes.at;
  let pixel = 0;
  if (at + sizes.reduce((a, b) => a + b) !== data.length) throw new RangeError("a wrong size");
  sizes.forEach((size, lane) => {
    const coder = new Coder(data, at, at + size);
    const rows = Math.floor(height / LANES) + (lane < height % LANES ? 1 : 0);
    decodeBand(coder, tables, valueOf, values.subarray(pixel, pixel + rows * width), width);
    if (!coder.atEnd()) throw new RangeError("a damaged depth image");
    at += size;
    pixel += rows * width;
  });
  return values;
}
