// What `apply` writes is sound glTF: the Khronos validator finds in the edited gallery models no issue that the model
// itself has not, at both ends of every slider and with the slider as an animation or as morph targets, with gaps closed, of
// one part alone, and with the program inside.
import { validateBytes } from 'gltf-validator';
import { beforeAll, describe, expect, it } from 'vitest';
import { embedSliders } from '../../web/src/program/embedded';
import type { Program, Shape } from '../../web/src/program/types';
import { call, type LoadedModule, loadModule } from './module';

interface GalleryEntry {
  id: string;
  requests: { request: string; edit: unknown }[];
}

let core: LoadedModule;
let files: Uint8Array[];
let models: GalleryEntry[];

beforeAll(async () => {
  core = await loadModule();
  const gallery = call<{ models: GalleryEntry[] }>(core, 'gallery', {});
  models = gallery.result.models;
  files = gallery.buffers;
});

async function issues(glb: Uint8Array): Promise<string[]> {
  const report = await validateBytes(glb, { maxIssues: 0 });
  const { messages } = report.issues;
  return [...new Set(messages.map(({ severity, code, pointer }) => `${severity} ${code} ${pointer}`))].sort();
}

describe('the Khronos validator', () => {
  it('finds nothing at all in the models of the gallery', async () => {
    for (const file of files) expect(await issues(file)).toEqual([]);
  });

  it('notices a wrong bound, so its silence means something', async () => {
    const text = Buffer.from(files[0] as Uint8Array).toString('latin1');
    const spoilt = Buffer.from(
      text.replace(/"max":\[(\d)/, (_, digit) => `"max":[${(Number(digit) + 1) % 10}`),
      'latin1',
    );
    expect(await issues(spoilt)).not.toEqual([]);
  });

  it('finds nothing in any edited model', { timeout: 120_000 }, async () => {
    let checked = 0;
    for (const [index, model] of models.entries()) {
      const { shape } = call<{ shape: Shape }>(core, 'open', { name: model.id, external: [] }, [
        files[index] as Uint8Array,
      ]).result;
      const only = shape.parts.filter((part) => !part.virtual).slice(0, 1);
      for (const { request, edit } of model.requests) {
        const { program } = call<{ program: Program }>(core, 'propagate', { edit }).result;
        const { name, min, max } = (program.layers[0] as Program['layers'][number]).parameter;
        const counts = JSON.stringify(program).includes('change_count');
        const outputs = [[min], [max]].map((values) => call(core, 'apply', { program, values }).buffers[0]);
        // Counts that change have no animation; the core says so.
        if (!counts) {
          outputs.push(call(core, 'apply', { program, values: [max], animate: name }).buffers[0]);
          outputs.push(call(core, 'apply', { program, values: [0], morph: true }).buffers[0]);
        }
        outputs.push(call(core, 'apply', { program, values: [max], repair: true }).buffers[0]);
        const alone = call(core, 'apply', { program, values: [max], only: only.map(({ id }) => id) }).buffers[0];
        outputs.push(alone);
        const embedded = embedSliders(files[index] as Uint8Array, {
          format: 'parsel/sliders',
          version: 1,
          program,
          off: [],
          shape,
          hidden: [],
        });
        expect(embedded.ok).toBe(true);
        if (embedded.ok) outputs.push(embedded.value);
        for (const output of outputs) {
          // The nodes of instances that are no longer there, and of parts that are left out, stay, unused, so that no other
          // index changes.
          const found = (await issues(output as Uint8Array)).filter(
            (issue) => !((counts || output === alone) && issue.startsWith('2 UNUSED_OBJECT /nodes/')),
          );
          expect(found, `${model.id}: ${request}`).toEqual([]);
          checked++;
        }
      }
    }
    expect(checked).toBeGreaterThan(100);
  });
});
