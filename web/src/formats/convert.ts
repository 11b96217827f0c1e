// A file of another format to a GLB, which the core and the scene both read. Runs in a worker of its own
// (worker/convert.worker.ts), and under Node.
import { refuseUnfit, toGlb } from './glb';
import { baseName, type Format, FormatError, type Model, type Source } from './model';
import { nameNodes, shownFile } from './names';
import { readObj } from './obj';
import { readPly } from './ply';
import { readStl } from './stl';
import { readThreeMf } from './threemf';

export interface Converted {
  /** A GLB with everything in it. */
  readonly glb: Uint8Array<ArrayBuffer>;
  /** What was left out or could not be found, in sentences. */
  readonly remarks: readonly string[];
}

const readers: Readonly<Record<Format, (source: Source, limit: number) => Model>> = {
  obj: readObj,
  stl: readStl,
  ply: readPly,
  '3mf': readThreeMf,
};

/**
 * The same files give the same bytes, so that a link finds its model by hash.
 * @param limit bytes that the file may unfold to. Rejects with a FormatError.
 */
export async function convert(source: Source, format: Format, limit: number): Promise<Converted> {
  try {
    const model = readers[format](source, limit);
    const name = baseName(source.path);
    refuseUnfit(model, shownFile(source.path), limit);
    nameNodes(model.nodes, name);
    return { glb: await toGlb(model, name), remarks: model.remarks };
  } catch (error) {
    if (error instanceof FormatError) throw error;
    // The readers of three and fflate throw what they throw; memory ends with a RangeError as well.
    const reason = error instanceof Error ? error.message : String(error);
    throw new FormatError(
      `${shownFile(source.path)} cannot be read (${reason}). Export it again, or with fewer triangles.`,
    );
  }
}
