// Text of files with very many lines, and how numbers and names are written in them.

/** Lines that are encoded bit by bit: all of them in one string would be too long for a browser. */
export class Text {
  readonly #chunks: Uint8Array[] = [];
  #lines: string[] = [];

  line(line: string): void {
    this.#lines.push(line);
    if (this.#lines.length >= 10_000) this.#encode();
  }

  /** UTF-8. @param head comes first */
  bytes(head: string): Uint8Array<ArrayBuffer> {
    this.#encode();
    const chunks = [new TextEncoder().encode(head), ...this.#chunks];
    const all = new Uint8Array(chunks.reduce((sum, { length }) => sum + length, 0));
    let at = 0;
    for (const chunk of chunks) {
      all.set(chunk, at);
      at += chunk.length;
    }
    return all;
  }

  #encode(): void {
    if (this.#lines.length > 0) this.#chunks.push(new TextEncoder().encode(`${this.#lines.join('\n')}\n`));
    this.#lines = [];
  }
}

/** The shortest decimal that reads as the same 32-bit float. */
export function shortest(value: number): string {
  const float = Math.fround(value);
  for (const digits of [6, 7, 8]) {
    const short = Number(float.toPrecision(digits));
    if (Math.fround(short) === float) return String(short);
  }
  return String(Number(float.toPrecision(9)));
}

/** A name where a line ends it. */
export const oneLine = (name: string): string => name.replace(/[\p{Cc}\u2028\u2029]+/gu, ' ').trim();
