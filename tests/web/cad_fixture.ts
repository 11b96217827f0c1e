// The gallery's CAD programs, opened in a session as the page does, with the core itself behind it.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import * as v from 'valibot';
import type { Shape } from '../../web/src/program/types';
import type { CadSource, ModelFiles } from '../../web/src/scene/load';
import { emptyDocument, noLabels } from '../../web/src/session/document';
import { familyOf, withProgramRead } from '../../web/src/session/family';
import type { FamilyState } from '../../web/src/session/family_found';
import { withFamily } from '../../web/src/session/family_state';
import type { ModelCore } from '../../web/src/session/model_core';
import { createSession } from '../../web/src/session/session';
import { methodSchemas } from '../../web/src/worker/protocol';
import { fakeCore } from './fake_core';
import { call as callCore, type LoadedModule } from './module';

export const programText = (name: string) =>
  new Uint8Array(readFileSync(fileURLToPath(new URL(`../../core/gallery/programs/${name}`, import.meta.url))));
export const options = { signal: new AbortController().signal, onProgress: () => {} };

type CadMethod = 'open_cad' | 'find_family' | 'family_text' | 'cad_prompt' | 'read_cad_replies';

export function cadCore(module: LoadedModule): ModelCore {
  const call = <M extends CadMethod>(method: M, parameters: unknown, given: Uint8Array[] = []) => {
    const { result, buffers } = callCore<unknown>(module, method, parameters, given);
    return { result: v.parse(methodSchemas[method].result, result) as never, buffers };
  };
  return {
    ...fakeCore(),
    async readCad(name, program) {
      const { result, buffers } = call('open_cad', { name }, [program]);
      return { read: result, glb: buffers[0] as Uint8Array };
    },
    async findFamily(about) {
      const { result, buffers } = call('find_family', about);
      return { found: result, pictures: buffers };
    },
    familyText: async (about) => call('family_text', about).result,
    cadPrompt: async (about) => call('cad_prompt', about).result,
    readCadReplies: async (about) => call('read_cad_replies', about).result,
  };
}

/** @param text the program and its variations; absent: the gallery's of that name */
export async function openProgram(
  core: ModelCore,
  module: LoadedModule,
  name: string,
  text?: { readonly scad: string; readonly variations: unknown },
) {
  const bytes = (one: string) => new TextEncoder().encode(one);
  const main = text === undefined ? programText(`${name}.scad`) : bytes(text.scad);
  const beside = { name, main, external: new Map() };
  const variations =
    text === undefined ? programText(`${name}.variations.json`) : bytes(JSON.stringify(text.variations));
  const program = { variations };
  const files = (await withProgramRead(core, { ...beside, program }, options)) as ModelFiles & { cad: CadSource };
  const { shape } = callCore<{ shape: Shape }>(module, 'open', { name, external: [] }, [files.main]).result;
  const model = { files, shape, source: { kind: 'file' as const }, labels: noLabels };
  const session = createSession();
  const source = await familyOf(core, model, undefined, options);
  session.replaceDocument(withFamily({ ...emptyDocument, model }, source, undefined, session.newEntry), `open ${name}`);
  const family = () => session.document.value.family as FamilyState;
  return { session, family, model, cad: files.cad };
}
