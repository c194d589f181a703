// Where do the bytes of a chunk come from, and how are they decoded?

/** Gives the gzipped bytes of named chunks. */
export interface ChunkSource {
  has(name: string): boolean;
  gzip(name: string): Promise<Uint8Array<ArrayBuffer>>;
}

type Base64Constructor = { fromBase64?(text: string): Uint8Array<ArrayBuffer> };

export function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const decode = (Uint8Array as unknown as Base64Constructor).fromBase64;
  if (decode) return decode.call(Uint8Array, text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** The chunks that stand in the page's own script elements. */
export class PageChunks implements ChunkSource {
  private readonly elements = new Map<string, Element>();

  constructor() {
    for (const element of document.querySelectorAll('script[type="application/x-graze-chunk"]'))
      this.elements.set(element.getAttribute('data-name') ?? '', element);
  }

  has(name: string): boolean {
    return this.elements.has(name);
  }

  async gzip(name: string): Promise<Uint8Array<ArrayBuffer>> {
    const element = this.elements.get(name);
    if (!element) throw new Error(`The page has no chunk "${name}".`);
    return fromBase64(element.textContent ?? '');
  }
}

/** The chunks of a .grazeview file. Only its table of contents is read at first. */
export class FileChunks implements ChunkSource {
  private constructor(private readonly file: Blob, private readonly parts: Map<string, [number, number]>) {}

  static async open(file: Blob): Promise<FileChunks> {
    const text = new TextDecoder();
    const read = async (from: number, to: number) => new DataView(await file.slice(from, to).arrayBuffer());
    if (text.decode(await read(0, 8)) !== 'GRZVIEW1') throw new Error('This is not a .grazeview file.');
    const parts = new Map<string, [number, number]>();
    for (let at = 8; at < file.size; ) {
      const sizes = await read(at, at + 12);
      if (sizes.byteLength < 12) throw new Error('The file ends in the middle of a chunk.');
      const begin = at + 12 + sizes.getUint32(0, true);
      const end = begin + Number(sizes.getBigUint64(4, true));
      if (end > file.size) throw new Error('The file ends in the middle of a chunk.');
      parts.set(text.decode(await read(at + 12, begin)), [begin, end]);
      at = end;
    }
    return new FileChunks(file, parts);
  }

  has(name: string): boolean {
    return this.parts.has(name);
  }

  async gzip(name: string): Promise<Uint8Array<ArrayBuffer>> {
    const part = this.parts.get(name);
    if (!part) throw new Error(`The file has no chunk "${name}".`);
    return new Uint8Array(await this.file.slice(part[0], part[1]).arrayBuffer());
  }
}

export async function gunzip(bytes: Uint8Array<ArrayBuffer>): Promise<ArrayBuffer> {
  const stream = new DecompressionStream('gzip');
  const writer = stream.writable.getWriter();
  // A bad chunk fails where it is read; here it is only kept from being reported twice.
  writer.write(bytes).catch(() => {});
  writer.close().catch(() => {});
  return new Response(stream.readable).arrayBuffer();
}

const ARRAY_TYPES = {
  u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, i32: Int32Array, f32: Float32Array, f64: Float64Array,
};
interface ArrayEntry { type: keyof typeof ARRAY_TYPES; offset: number; count: number }

/** A decoded chunk: a JSON header and arrays, which are views of the chunk's memory. */
export class Table {
  readonly header: Record<string, unknown>;
  readonly byteLength: number;
  private readonly start: number;

  constructor(private readonly buffer: ArrayBuffer) {
    const length = new DataView(buffer).getUint32(0, true);
    this.header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, length)));
    this.start = 8 + length;
    this.byteLength = buffer.byteLength;
  }

  u8(name: string): Uint8Array { return this.view(name, 'u8') as Uint8Array; }
  u32(name: string): Uint32Array { return this.view(name, 'u32') as Uint32Array; }
  f64(name: string): Float64Array { return this.view(name, 'f64') as Float64Array; }

  has(name: string): boolean {
    return name in (this.header.arrays as object);
  }

  private view(name: string, type: keyof typeof ARRAY_TYPES) {
    const entry = (this.header.arrays as Record<string, ArrayEntry>)[name];
    if (!entry) return new ARRAY_TYPES[type](0);
    if (entry.type !== type) throw new Error(`The array "${name}" is ${entry.type}, not ${type}.`);
    return new ARRAY_TYPES[type](this.buffer, this.start + entry.offset, entry.count);
  }
}

export async function readJson(source: ChunkSource, name: string): Promise<unknown> {
  return JSON.parse(new TextDecoder().decode(await gunzip(await source.gzip(name))));
}

export async function readTable(source: ChunkSource, name: string): Promise<Table> {
  return new Table(await gunzip(await source.gzip(name)));
}

/** Keeps decoded blocks, the least recently used of which go first. */
export class BlockCache<T extends { byteLength: number }> {
  private readonly blocks = new Map<string, { promise: Promise<T>; value?: T }>();
  decodeMs: number[] = [];

  constructor(private readonly maxBytes: number, private readonly make: (name: string) => Promise<T>) {}

  /** The block, if it is here already. */
  peek(name: string): T | undefined {
    return this.blocks.get(name)?.value;
  }

  get(name: string): Promise<T> {
    const known = this.blocks.get(name);
    if (known) {
      this.blocks.delete(name);
      this.blocks.set(name, known);
      return known.promise;
    }
    const began = performance.now();
    const entry: { promise: Promise<T>; value?: T } = { promise: this.make(name) };
    this.blocks.set(name, entry);
    entry.promise.then((value) => {
      entry.value = value;
      this.decodeMs.push(performance.now() - began);
      if (this.decodeMs.length > 200) this.decodeMs.shift();
      this.shrink(name);
    }, () => this.blocks.delete(name));
    return entry.promise;
  }

  /** Three blocks stay in any case, so that playing never throws away what comes next. */
  private shrink(newest: string): void {
    let bytes = 0;
    for (const { value } of this.blocks.values()) bytes += value?.byteLength ?? 0;
    for (const [name, { value }] of this.blocks) {
      if (bytes <= this.maxBytes || this.blocks.size <= 3) return;
      if (!value || name === newest) continue;
      bytes -= value.byteLength;
      this.blocks.delete(name);
    }
  }
}
