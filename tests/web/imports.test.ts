// That the tables of imports and includes, and the search for circles, catch what they are there for.
import { describe, expect, it } from 'vitest';
import { circleFaults, importFaults } from '../check_imports.mjs';
import { circleFaults as includedInCircles } from '../check_includes.mjs';

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
    ['formats/obj.ts', "import { loadModel } from '../scene/load';", /formats makes GLBs of files/],
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

describe('modules that need each other in a circle', () => {
  it('are named in the order of need, types and late imports included', () => {
    const texts = new Map([
      ['session/a.ts', "import { b } from './b';\nimport { d } from './d';"],
      ['session/b.ts', "import type { C } from '../ui/c';"],
      ['ui/c.tsx', "  const { a } = await import('../session/a');"],
      ['session/d.ts', "import { c } from '../ui/e';"],
      ['ui/e.tsx', "import * as v from 'valibot';"],
    ]);
    expect(circleFaults(texts)).toEqual([
      expect.stringMatching(/^web\/src\/session\/a → web\/src\/session\/b → web\/src\/ui\/c → web\/src\/session\/a: /),
    ]);
  });

  it('are each told once, by a shortest circle', () => {
    const texts = new Map([
      ['ui/a.ts', "import './b';\nimport './c';"],
      ['ui/b.ts', "import './c';"],
      ['ui/c.ts', "import './a';"],
      ['ui/x.ts', "import './y';"],
      ['ui/y.ts', "import './x';\nimport './a';"],
      ['ui/z.ts', "import './z';"],
    ]);
    expect(circleFaults(texts).map((fault) => fault.split(': ')[0]?.replaceAll('web/src/ui/', ''))).toEqual([
      'a → c → a',
      'x → y → x',
      'z → z',
    ]);
  });

  it('are found in the core through sources, too', () => {
    const texts = new Map([
      ['core/edit/a.h', '#include <vector>\n#include "core/edit/types.h"'],
      ['core/edit/a.cpp', '#include "core/edit/a.h"\n#include "core/edit/b.h"'],
      ['core/edit/b.h', '#include "core/edit/a.h"'],
      ['core/edit/types.h', ''],
    ]);
    const circle = 'core/edit/a → core/edit/b → core/edit/a';
    expect(includedInCircles(texts, {})).toEqual([expect.stringMatching(`^${circle}: they need each other`)]);
    expect(includedInCircles(texts, { [circle]: 'a reason' })).toEqual([]);
    texts.set('core/edit/b.h', '#include "core/edit/types.h"');
    expect(includedInCircles(texts, {})).toEqual([]);
    expect(includedInCircles(texts, { [circle]: 'a reason' })).toEqual([expect.stringMatching('take it off the list')]);
  });
});
