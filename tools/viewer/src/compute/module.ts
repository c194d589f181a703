// How does the page call the module of graze that computes here?

import { fromBase64, gunzip } from '../data/chunks';

type Call = (...numbers: number[]) => number;

/** What the module shows: see tools/wasm/page_exports.cpp. */
interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  [name: string]: unknown;
}

const element = () => document.querySelector('script[type="application/x-graze-module"]');

/** Whether the page was built with the module. */
export function hasModule(): boolean {
  return element() !== null;
}

export class ComputingModule {
  private constructor(private readonly exports: Exports) {}

  static async load(): Promise<ComputingModule> {
    return ComputingModule.from(await gunzip(fromBase64(element()?.textContent ?? '')));
  }

  static async from(bytes: ArrayBuffer): Promise<ComputingModule> {
    const made: { exports?: Exports } = {};
    const { instance } = await WebAssembly.instantiate(bytes, importsOf(() => made.exports!.memory));
    made.exports = instance.exports as Exports;
    made.exports._initialize();
    return new ComputingModule(made.exports);
  }

  /** Calls a function with numbers, texts and arrays. Fails with the module's words where it returns -1. */
  call(name: string, ...values: (number | string | Float64Array | Uint32Array)[]): number {
    const taken: number[] = [];
    try {
      const result = this.function(name)(...values.map((value) => (typeof value === 'number' ? value : this.put(value, taken))));
      if (result === -1) throw new Error(this.text(this.function('last_error')()));
      return result;
    } finally {
      for (const memory of taken) this.function('release')(memory);
    }
  }

  /** A copy of bytes of the module. */
  bytes(from: number, size: number): ArrayBuffer {
    return this.exports.memory.buffer.slice(from, from + size);
  }

  private function(name: string): Call {
    return this.exports[name] as Call;
  }

  private put(value: string | Float64Array | Uint32Array, taken: number[]): number {
    const bytes = typeof value === 'string' ? new TextEncoder().encode(`${value}\0`)
      : new Uint8Array(value.buffer, value.byteOffset, value.byteLength);
    const at = this.function('allocate')(Math.max(bytes.length, 1));
    if (at === 0) throw new Error('There is no memory to compute in this page.');
    taken.push(at);
    new Uint8Array(this.exports.memory.buffer).set(bytes, at);
    return at;
  }

  private text(at: number): string {
    const memory = new Uint8Array(this.exports.memory.buffer);
    return new TextDecoder().decode(memory.subarray(at, memory.indexOf(0, at)));
  }
}

/** What the C library of the module asks for. */
function importsOf(memory: () => WebAssembly.Memory): WebAssembly.Imports {
  const wasi = {
    clock_time_get(_clock: number, _precision: bigint, at: number): number {
      new DataView(memory().buffer).setBigUint64(at, BigInt(Math.round(1e6 * performance.now())), true);
      return 0;
    },
    proc_exit(code: number): never {
      throw new Error(`The module that computes in this page ended with ${code}.`);
    },
  };
  return { wasi_snapshot_preview1: wasi, env: { emscripten_notify_memory_growth: () => {} } };
}
