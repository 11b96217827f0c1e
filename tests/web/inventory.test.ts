// What is said of a model that was opened: counts, and parts that nothing joins. And hosts that models may come from.
import { describe, expect, it } from 'vitest';
import { contentSecurityPolicy } from '../../web/csp';
import type { Shape } from '../../web/src/program/types';
import { inventoryOf, inventoryWords } from '../../web/src/session/inventory';
import { hostsOf, mayFetchFrom } from '../../web/src/session/model_hosts';
import { box, oneBox, twoBoxes } from './box_shapes';

describe('what was found', () => {
  it('names the parts that nothing joins to the others', () => {
    const lonely: Shape = { ...twoBoxes, parts: [...twoBoxes.parts, box('knob', 2, [0, 1, 0], [0.1, 0.1, 0.1])] };
    expect(inventoryOf(lonely)).toMatchObject({ parts: 3, loose: ['knob'], stands: false });
    expect(inventoryOf(twoBoxes).loose).toEqual([]);
    expect(inventoryOf(oneBox).loose).toEqual([]);
  });

  it('takes the instances of a row for joined by what stands for them', () => {
    const row: Shape = {
      ...twoBoxes,
      parts: [
        ...twoBoxes.parts,
        { ...box('row', -1, [0, 0, 0], [1, 1, 1]), virtual: true, members: ['left', 'right'] },
      ],
      relations: [],
    };
    expect(inventoryOf(row)).toMatchObject({ parts: 2, loose: [] });
  });

  it('reads as one line', () => {
    const found = { parts: 17, mirrors: 9, rows: 1, stands: true, loose: [] };
    expect(inventoryWords(found)).toBe('17 parts, 9 mirror images, 1 row, stands on the floor');
    expect(inventoryWords({ ...found, parts: 1, mirrors: 0, rows: 0, stands: false })).toBe('1 part');
  });
});

describe('hosts of models', () => {
  const may = (address: string) => mayFetchFrom(new URL(address), 'https://here.example');
  it('are the page’s own, this machine’s, and the listed ones over https', () => {
    expect(may('https://here.example/a.glb')).toBe(true);
    expect(may('http://localhost:8080/a.glb')).toBe(true);
    expect(may('https://cdn.jsdelivr.net/gh/a/b@1/c.glb')).toBe(true);
    expect(may('http://cdn.jsdelivr.net/c.glb')).toBe(false);
    expect(may('https://cdn.jsdelivr.net.example.org/c.glb')).toBe(false);
    expect(may('https://user@example.org/c.glb')).toBe(false);
  });

  it('stand in the policy, and nothing that is no host gets into it', () => {
    expect(contentSecurityPolicy(false)).toMatch(/connect-src [^;]*https:\/\/raw\.githubusercontent\.com/);
    expect(hostsOf('a.example, b.example:8443')).toEqual(['a.example', 'b.example:8443']);
    expect(() => hostsOf("a.example; script-src 'unsafe-eval'")).toThrow(/is no host/);
    expect(() => hostsOf('https://a.example')).toThrow(/is no host/);
    expect(hostsOf('')).toEqual([]);
  });
});
