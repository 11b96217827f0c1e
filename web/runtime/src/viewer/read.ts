// From the addresses in the element's attributes to a model and its program.
import { slidersIn, withoutSliders } from '../../../src/program/embedded';
import { loadModel } from '../../../src/scene/load';
import type { LoadedModel } from '../../../src/scene/meshes';
import { ParselError, unwrap } from '../error';
import { compile, type Evaluate, type LoadedProgram, loadProgram, ofSliders } from '../program';

export interface Sources {
  readonly src: string;
  /** `parsel/sliders` or `parsel/program`; null: what the model holds. */
  readonly program: string | null;
  /** `parsel/shape`, for a program that comes without. */
  readonly shape: string | null;
}

export interface ReadModel {
  readonly loaded: LoadedModel;
  readonly program: LoadedProgram;
  readonly evaluate: Evaluate;
}

const refusal = (place: string, cause: string, fix: string) =>
  new ParselError({ stage: 'runtime/viewer', place, cause, fix });

/** Throws a ParselError, or the signal's reason. */
export async function read({ src, program, shape }: Sources, signal: AbortSignal): Promise<ReadModel> {
  const [glb, programText, shapeText] = await Promise.all([
    bytesOf(src, signal),
    program === null ? null : textOf(program, signal),
    shape === null ? null : textOf(shape, signal),
  ]);
  const own = programText === null ? embedded(glb, src) : loadProgram(programText);
  const evaluate = compile(own, shapeText === null ? own.shape : JSON.parse(shapeText));
  const main = unwrap(withoutSliders(glb)); // three need not carry them about
  const loaded = await loadModel({ name: src, main, external: new Map() }).catch((error: unknown) => {
    const cause = error instanceof Error ? error.message : String(error);
    throw refusal(src, cause, 'export it as an uncompressed .glb, as the page does');
  });
  if (!signal.aborted) return { loaded, program: own, evaluate };
  loaded.dispose();
  throw signal.reason;
}

function embedded(glb: Uint8Array, src: string): LoadedProgram {
  const sliders = unwrap(slidersIn(glb));
  if (sliders !== null) return ofSliders(sliders);
  throw refusal(
    src,
    'the file holds no sliders',
    'name them in the program attribute, or export “Model with sliders” from the page',
  );
}

async function fetched(address: string, signal: AbortSignal): Promise<Response> {
  const failed = (why: string) =>
    refusal(address, `it could not be fetched (${why})`, 'check the address and the policy');
  if (!URL.canParse(address, document.baseURI)) throw failed('that is no address');
  const response = await fetch(new URL(address, document.baseURI), { signal }).catch((error: unknown) => {
    signal.throwIfAborted();
    throw failed(error instanceof Error ? error.message : 'no answer');
  });
  if (!response.ok) throw failed(String(response.status));
  return response;
}

const bytesOf = async (address: string, signal: AbortSignal) =>
  new Uint8Array(await (await fetched(address, signal)).arrayBuffer());
const textOf = async (address: string, signal: AbortSignal) => (await fetched(address, signal)).text();
