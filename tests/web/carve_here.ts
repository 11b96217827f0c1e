// Carving as the page's worker does it, under Node.
import { createRequire } from 'node:module';
import { type CarveFiles, carve as carveWith } from '../../web/src/carve/carve';
import type { Carved, CarveStep } from '../../web/src/carve/steps';
import { loadManifold } from '../../web/src/solid/manifold';

const require = createRequire(new URL('../../web/package.json', import.meta.url));
const manifold = await loadManifold(require.resolve('manifold-3d/manifold.wasm'));

export const carve = (files: CarveFiles, step: CarveStep): Promise<Carved> =>
  carveWith(files, step, async () => manifold.triangulate);
