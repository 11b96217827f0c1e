// The recorded kinds of the gallery's CAD programs, against what was written down by hand before any reply
// (tests/eval/families.json), and the recorded names of parts against those that were taken away.
import { beforeAll, describe, expect, it } from 'vitest';
import { readRecordings } from '../../web/tools/prompts.mjs';
import { implied, measureFamilies, readWanted, score } from '../eval/families.mjs';
import { measureGalleryNames } from '../eval/names.mjs';
import { type Caller, callerOf, loadWithCad } from './module';

let core: Caller;
beforeAll(async () => {
  core = callerOf(await loadWithCad());
});

describe('the score of a family', () => {
  const holding = [
    'equal(a.sx,b.sx)',
    'equal(b.sx,c.sx)',
    'equal(a.sx,c.sx)',
    'coplanar(a.x-,b.x-)',
    'coplanar(a.x+,b.x+)',
  ];
  it('counts what follows from what is there', () => {
    expect([...implied(['equal(a.sx,b.sx)', 'equal(b.sx,c.sx)'], holding)]).toContain('equal(a.sx,c.sx)');
    expect([...implied(['coplanar(a.x-,b.x-)', 'coplanar(a.x+,b.x+)'], holding)]).toContain('equal(a.sx,b.sx)');
    expect([...implied(['coplanar(a.x-,b.x-)'], holding)]).toEqual(['coplanar(a.x-,b.x-)']);
  });
  it('is less than one for what is wrong and for what is missed', () => {
    expect(score(holding, ['equal(a.sx,b.sx)'], holding)).toMatchObject({ precision: 0.2, recall: 1 });
    expect(score(['equal(a.sx,b.sx)'], holding, holding)).toMatchObject({ precision: 1, recall: 0.2 });
  });
});

describe('recorded kinds', () => {
  it('share what was wanted beforehand, and little else', () => {
    const all = measureFamilies(core, readRecordings());
    expect(all.map(({ id }) => id)).toEqual(Object.keys(readWanted()));
    for (const { id, kinds } of all) {
      expect(kinds, id).toHaveLength(6);
      for (const { name, votes, refused } of kinds) expect([id, name, votes, refused.length]).toEqual([id, name, 5, 0]);
    }
    const mean = (of: 'precision' | 'recall') => all.reduce((sum, one) => sum + one.score[of], 0) / all.length;
    expect(mean('precision')).toBeGreaterThanOrEqual(0.95);
    expect(mean('recall')).toBeGreaterThanOrEqual(0.9);
  });
});

describe('recorded names of parts', () => {
  it('find the same relations as the names that were taken away', () => {
    const all = measureGalleryNames(core, readRecordings());
    expect(all).toHaveLength(10);
    const sum = (of: 'parts' | 'same' | 'together') => all.reduce((total, one) => total + one[of], 0);
    expect(sum('same') / sum('parts')).toBeGreaterThanOrEqual(0.85);
    expect(sum('together') / sum('parts')).toBeGreaterThanOrEqual(0.85);
  });
});
