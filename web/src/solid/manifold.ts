// Manifold's module, fetched when something is to be united or cut, never before.
import type { ManifoldToplevel } from 'manifold-3d/manifold';

let loading: Promise<ManifoldToplevel> | undefined;

/** @param wasmUrl of manifold.wasm */
export function loadManifold(wasmUrl: string): Promise<ManifoldToplevel> {
  loading ??= import('manifold-3d/manifold').then(async ({ default: create }) => {
    const module = await create({ locateFile: () => wasmUrl });
    module.setup();
    return module;
  });
  loading.catch(() => {
    loading = undefined; // without a network now, perhaps with one next time
  });
  return loading;
}
