/** LCM's wire format: a fingerprint of 64 bits, then the fields in order, big-endian. */

/** Reads fields; throws RangeError where the bytes end before the message does. */
export class Reader {
  private at = 0;
  private readonly view: DataView;

  constructor(private readonly data: Uint8Array) {
    this.view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  }

  int8_t = () => this.view.getInt8(this.step(1));
  byte = () => this.view.getUint8(this.step(1));
  boolean = () => this.view.getInt8(this.step(1));
  int16_t = () => this.view.getInt16(this.step(2));
  int32_t = () => this.view.getInt32(this.step(4));
  int64_t = () => this.view.getBigInt64(this.step(8));
  float = () => this.view.getFloat32(this.step(4));
  double = () => this.view.getFloat64(this.step(8));

  fingerprint(): bigint {
    return this.view.getBigUint64(this.step(8));
  }

  /** A string's length counts its closing zero. */
  string(): string {
    const text = this.bytes(this.int32_t());
    if (text.length === 0) throw new RangeError("a string without its closing zero");
    return new TextDecoder().decode(text.subarray(0, -1));
  }

  bytes(count: number): Uint8Array {
    const first = this.step(count);
    return this.data.subarray(first, first + count);
  }

  /** Every element takes a byte at least, so no count may pass the bytes that are left. */
  list<T>(count: number, read: () => T): T[] {
    if (count < 0 || count > this.left()) throw new RangeError(`a count of ${count}`);
    return Array.from({ length: count }, read);
  }

  left(): number {
    return this.data.byteLength - this.at;
  }

  private step(size: number): number {
    if (size < 0 || size > this.left()) throw new RangeError("a message that ends early");
    const first = this.at;
    this.at += size;
    return first;
  }
}

/** Appends fields; throws RangeError if a count does not match its list. */
export class Writer {
  private data = new Uint8Array(256);
  private view = new DataView(this.data.buffer);
  private at = 0;

  int8_t = (value: number) => this.put(1, (view, at) => view.setInt8(at, value));
  byte = (value: number) => this.put(1, (view, at) => view.setUint8(at, value));
  boolean = (value: number) => this.put(1, (view, at) => view.setInt8(at, value));
  int16_t = (value: number) => this.put(2, (view, at) => view.setInt16(at, value));
  int32_t = (value: number) => this.put(4, (view, at) => view.setInt32(at, value));
  int64_t = (value: bigint) => this.put(8, (view, at) => view.setBigInt64(at, value));
  float = (value: number) => this.put(4, (view, at) => view.setFloat32(at, value));
  double = (value: number) => this.put(8, (view, at) => view.setFloat64(at, value));

  fingerprint(value: bigint): void {
    this.put(8, (view, at) => view.setBigUint64(at, value));
  }

  string(value: string): void {
    const text = new TextEncoder().encode(value);
    this.int32_t(text.length + 1);
    this.bytes(text, text.length);
    this.byte(0);
  }

  bytes(value: Uint8Array, count: number): void {
    if (value.length !== count) throw new RangeError(`${value.length} bytes, not ${count}`);
    const first = this.step(count);
    this.data.set(value, first);
  }

  list<T>(values: T[], count: number, write: (value: T) => void): void {
    if (values.length !== count) throw new RangeError(`${values.length} elements, not ${count}`);
    values.forEach((value) => write(value));
  }

  finished(): Uint8Array {
    return this.data.slice(0, this.at);
  }

  /** `set` gets the view as it is after growing. */
  private put(size: number, set: (view: DataView, at: number) => void): void {
    const first = this.step(size);
    set(this.view, first);
  }

  private step(size: number): number {
    const first = this.at;
    this.at += size;
    if (this.at > this.data.length) this.grow();
    return first;
  }

  private grow(): void {
    const larger = new Uint8Array(2 * this.at);
    larger.set(this.data);
    this.data = larger;
    this.view = new DataView(larger.buffer);
  }
}

export interface Codec<T> {
  /** Throws RangeError if `data` is not exactly one message of this type. */
  decode(data: Uint8Array): T;
  encode(message: T): Uint8Array;
}

export function codec<T>(
  fingerprint: bigint,
  read: (r: Reader) => T,
  write: (w: Writer, message: T) => void,
): Codec<T> {
  return {
    decode(data) {
      const reader = new Reader(data);
      if (reader.fingerprint() !== fingerprint) throw new RangeError("a message of another type");
      const message = read(reader);
      if (reader.left() > 0) throw new RangeError(`${reader.left()} bytes too many`);
      return message;
    },
    encode(message) {
      const writer = new Writer();
      writer.fingerprint(fingerprint);
      write(writer, message);
      return writer.finished();
    },
  };
}
