// The cases of runtime.bench.mjs: a slider of a three.js scene, with everything that a step does before it is drawn.
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { compile, loadProgram } from '../../web/runtime/src/index';
import { attachSliders } from '../../web/runtime/src/three/index';
import { slidersOf } from '../../web/src/program/sliders';
import type { Shape } from '../../web/src/program/types';
import { randomProgram, randomShape } from '../web/random_program';
import { glbOf } from '../web/shape_glb';

async function prepare(shape: Shape, seed: number) {
  const record = slidersOf(randomProgram(shape, seed, { layers: 4, statements: 50, amount: 0.25 }), shape);
  const text = JSON.stringify(record);
  const glb = glbOf(shape);
  const start = performance.now();
  const loaded = loadProgram(text);
  const read = performance.now();
  const evaluate = compile(loaded);
  const compiled = performance.now();
  const gltf = await new GLTFLoader().parseAsync(Uint8Array.from(glb).buffer, '');
  const parsed = performance.now();
  const sliders = attachSliders(gltf, loaded);
  const attached = performance.now();
  return {
    parts: shape.parts.length,
    kilobytes: text.length / 1e3,
    times: { load: read - start, compile: compiled - read, attach: attached - parsed },
    names: sliders.parameters.map(({ name }) => name),
    evaluate: (value: number) => evaluate([value, value, value, value]),
    slide: (name: string, value: number) => sliders.set(name, value),
  };
}

export const cases = [
  { name: '100 parts', prepare: () => prepare(randomShape(1, { loose: 100, rows: 0, rings: 0 }), 2) },
  { name: '103 parts with 6 groups', prepare: () => prepare(randomShape(2, { loose: 70, rows: 3, rings: 3 }), 3) },
];
