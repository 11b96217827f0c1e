// Pictures of what a slider does: the least, the model as it is, and the most, of every proposal, drawn from the scene.
import { effect, signal } from '@preact/signals';
import { checkProgram } from '../program/check';
import { compileProgram, type Evaluator } from '../program/compile';
import type { Layer, Shape } from '../program/types';
import type { State } from '../scene/explode';
import { copyOf, type Picture, type Projection } from '../scene/pictures';
import { emptyProgram, type OpenModel } from '../session/document';
import type { Proposals } from '../session/proposals';
import { document } from '../session/session';
import { shown, stage } from './view';

const evaluators = new WeakMap<Layer, Evaluator | null>();

/** Of one layer alone, on its shape; null when it does not fit. Never the one that the stage shows. */
export function evaluatorOf(shape: Shape, layer: Layer): Evaluator | null {
  const known = evaluators.get(layer);
  if (known !== undefined) return known;
  const checked = checkProgram({ ...emptyProgram(shape), layers: [layer] }, shape);
  const evaluator = checked.ok ? compileProgram(checked.value, shape) : null;
  evaluators.set(layer, evaluator);
  return evaluator;
}

/** Three values of a slider: as far as it goes down, rest, and as far as it goes up. */
export const strip = ({ min, max }: Layer['parameter']): readonly number[] => [min, 0, max];

export function canvasOf(width: number, height: number): HTMLCanvasElement {
  return Object.assign(globalThis.document.createElement('canvas'), { width, height });
}

/** Draws pictures of a model (see Stage.paint); null while it does not stand on the stage. */
export function paint(model: OpenModel, pictures: readonly Picture[], framing?: readonly State[]): Projection | null {
  return shown.peek() === model.shape ? (stage.peek()?.paint(pictures, framing) ?? null) : null;
}

const stripSize = 192; // pixels

/** Addresses of the pictures of what is proposed. */
export const strips = signal<ReadonlyMap<Layer, readonly string[]>>(new Map());

/** Draws the strips of what is found, one a frame. Answers how to stop. */
export function drawStrips({ open, asked }: Proposals): () => void {
  let frame = 0;
  const stop = effect(() => {
    const { model } = document.value;
    const layers = open.value.flatMap(({ state }) => (state.kind === 'found' ? state.found.program.layers : []));
    const wanted = layers.find((layer) => !strips.value.has(layer));
    if (asked.value === null && strips.peek().size > 0) strips.value = new Map();
    cancelAnimationFrame(frame);
    if (wanted === undefined || model === null || stage.value === null || shown.value !== model.shape) return;
    frame = requestAnimationFrame(() => {
      strips.value = new Map(strips.peek()).set(wanted, drawStrip(model, wanted));
    });
  });
  return () => {
    cancelAnimationFrame(frame);
    stop();
  };
}

function drawStrip(model: OpenModel, layer: Layer): readonly string[] {
  const evaluator = evaluatorOf(model.shape, layer);
  if (evaluator === null) return [];
  const pictures = strip(layer.parameter).map((value): Picture => {
    evaluator.evaluate([value]);
    return { state: copyOf(evaluator), canvas: canvasOf(stripSize, stripSize) };
  });
  return paint(model, pictures) !== null ? pictures.map(({ canvas }) => canvas.toDataURL()) : [];
}

const numberedSize = 1024; // pixels

/** The model at rest with a number on each part, as the base64 of a PNG: what goes along with a prompt that says so. */
export function paintNumbered(numbered: readonly string[]): string | null {
  const { model } = document.peek();
  if (model === null) return null;
  const corners = Float64Array.from(model.shape.parts.flatMap((part) => part.corners.flat()));
  const canvas = canvasOf(numberedSize, numberedSize);
  const state = { corners, groups: model.shape.relations.map(() => null) };
  const project = paint(model, [{ state, canvas }]);
  const context = canvas.getContext('2d');
  if (project === null || context === null) return null;
  context.globalCompositeOperation = 'destination-over';
  context.fillStyle = '#ffffff';
  context.fillRect(0, 0, numberedSize, numberedSize);
  context.globalCompositeOperation = 'source-over';
  context.font = '600 22px sans-serif';
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  for (const [i, id] of numbered.entries()) {
    const part = model.shape.parts.findIndex((one) => one.id === id);
    if (part < 0) continue;
    const { x, y } = project(corners.subarray(part * 24, part * 24 + 24));
    context.beginPath();
    context.arc(x * numberedSize, y * numberedSize, 17, 0, 2 * Math.PI);
    context.fillStyle = '#ffffffd9';
    context.fill();
    context.strokeStyle = '#1d1f22';
    context.stroke();
    context.fillStyle = '#1d1f22';
    context.fillText(String(i + 1), x * numberedSize, y * numberedSize + 1);
  }
  return canvas.toDataURL().replace(/^data:image\/png;base64,/, '');
}
