// Kazhdan's reconstruction as a module of its own, fetched when a gap is to be filled, never before.
import type createModule from 'parsel-module/poisson.mjs';
import type { PoissonModuleOptions } from 'parsel-module/poisson.mjs';
import type { Reconstruct } from './types';

/** Of the points against the gradients: what the authors advise. */
const screening = 4;

/** @param create the module's factory, and `options`, what it is told: where its bytes are */
export async function loadPoisson(create: typeof createModule, options: PoissonModuleOptions): Promise<Reconstruct> {
  const module = await create(options);
  return (samples, depth) => {
    const at = module._malloc(samples.byteLength);
    if (at === 0) throw new Error('there is not enough memory for so many samples');
    module.HEAPF32.set(samples, at / 4);
    const vertices = module._poisson_reconstruct(at, samples.length / 6, depth, screening);
    module._free(at);
    // By copy: the memory may grow and move at the next call.
    const [positions, triangles] = [module._poisson_positions() / 4, module._poisson_triangles() / 4];
    return {
      positions: module.HEAPF32.slice(positions, positions + 3 * vertices),
      triangles: module.HEAPU32.slice(triangles, triangles + 3 * module._poisson_triangle_count()),
    };
  };
}
