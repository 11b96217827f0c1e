// That the table of imports catches what it is there for.
import { describe, expect, it } from 'vitest';
import { importFaults } from '../check_imports.mjs';

describe('an import', () => {
  it.each([
    ['program/parse.ts', "import type { Result } from './types';"],
    ['program/schema.ts', "import * as v from 'valibot';"],
    ['llm/http.ts', "import { parseJson } from '../program/json';"],
    ['session/files.ts', "  const { unzip } = await import('fflate');"],
    ['worker/convert.worker.ts', "import { convert } from '../formats/convert';"],
    ['main.tsx', "import { App } from './ui/App';"],
    ['../runtime/src/program.ts', "import { checkProgram } from '../../src/program/check';"],
    ['../runtime/src/three/index.ts', "import { ModelView } from '../../../src/scene/model_view';"],
    ['../runtime/src/viewer/element.ts', "import { misfitOf } from '../three/fit';"],
  ])('that the room of %s may make passes: %s', (file, line) => {
    expect(importFaults(file, line)).toEqual([]);
  });

  it.each([
    ['program/parse.ts', "import * as three from 'three';", /program reads, checks and evaluates/],
    ['program/parse.ts', "import type { Document } from '../session/document';", /program reads/],
    ['scene/stage.ts', "import { document } from '../session/session';", /scene draws what it is given/],
    ['llm/http.ts', "import { parse } from '../program/parse';", /llm asks language models/],
    ['formats/obj.ts', "import { loadModel } from '../scene/load';", /formats makes a GLB/],
    ['session/files.ts', "import { render } from 'preact';", /without a single element/],
    ['ui/App.tsx', "import { get } from 'idb-keyval';", /done in their rooms/],
    ['ui/App.tsx', "  await import('fflate');", /done in their rooms/],
    ['program/check.ts', "import { unwrap } from '../../runtime/src/error';", /program reads/],
    ['../runtime/src/index.ts', "import * as three from 'three';", /without three\.js/],
    ['../runtime/src/index.ts', "export { attachSliders } from './three/index';", /without three\.js/],
    [
      '../runtime/src/three/index.ts',
      "import { loadModel } from '../../../src/scene/load';",
      /neither a stage nor a loader/,
    ],
    [
      '../runtime/src/viewer/read.ts',
      "import { document } from '../../../src/session/session';",
      /on the stage of the page/,
    ],
    ['new/one.ts', '', /web\/src\/new: this folder has no row/],
  ])('that the room of %s may not make fails with its rule: %s', (file, line, rule) => {
    expect(importFaults(file, `\n${line}`)).toEqual([expect.stringMatching(rule)]);
  });
});
