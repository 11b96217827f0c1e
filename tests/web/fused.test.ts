// Models of the gallery whose parts are fused by boolean union, and models that are too much: what splitting makes of them.
import { describe, expect, it } from 'vitest';
import { dust, oneMesh, pointCloud, scan } from '../bench/large_models.mjs';
import { bestPairs, measureFused } from '../eval/fused.mjs';
import { call, loadModule } from './module';

const module = await loadModule();
const core = (method: string, parameters: unknown, buffers: Uint8Array[] = []) =>
  call(module, method, parameters as Record<string, unknown>, buffers);
const gallery = core('gallery', {});
const { models } = gallery.result as { models: { id: string }[] };

describe('a fused model', () => {
  it.each(models.map(({ id }, i) => [id, i] as const))(
    '%s: most of its surface lands in the right part',
    async (id, i) => {
      const { share, by, parts } = await measureFused(core, id, gallery.buffers[i] as Uint8Array);
      expect(by).toBe('regions');
      expect(share).toBeGreaterThan(0.85); // the worst had 0.88
      expect(share).toBeLessThan(1 + 1e-6);
      expect(parts).toBeGreaterThan(4);
    },
    60_000,
  );

  it('is measured by pairs in which nobody is twice', () => {
    expect(
      bestPairs([
        [3, 2],
        [3, 0],
      ]),
    ).toBe(5);
    expect(bestPairs([[5, 1, 1]])).toBe(5);
    expect(bestPairs([[5], [4], [1]])).toBe(5);
  });
});

describe('what cannot be split', () => {
  const split = (file: Uint8Array) => {
    const opened = core('open', { name: 'thing', external: [] }, [file]);
    expect(opened.result).toHaveProperty('shape');
    return core('split', { by: 'auto', fine: 0.5 }).result as { parts: number; warnings: { text: string }[] };
  };
  it('a scan of a million triangles is left whole, and it is said what to do', () => {
    const { parts, warnings } = split(scan());
    expect(parts).toBe(1);
    expect(warnings.map(({ text }) => text)).toEqual([
      'it hangs together and is as fine as a scan: cut it by hand where parts end',
    ]);
  }, 60_000);
  it('100,000 pieces of one size are refused with what to do instead', () => {
    expect(() => split(dust(100_000))).toThrow(
      /2000 pieces, however coarse.*leave it in one piece, and cut it by hand/,
    );
  }, 60_000);
  it.each([
    ['a point cloud', pointCloud(), /made of points.*open a model with triangle meshes/],
    ['a mesh without a triangle', oneMesh(new Float32Array(9), Uint32Array.of(0, 0, 0)), /triangle/],
  ])('%s does not open, and the message says why', (_, file, message) => {
    expect(() => core('open', { name: 'thing', external: [] }, [file])).toThrow(message);
  });
});
