// What measures the paper's pairs and the harder requests (tests/eval): where the slider is put, which relations are seen to be
// kept, whose fault a miss is, one question about many relations, pictures, and what the answers to a study say.
import { inflateSync } from 'node:zlib';
import { beforeAll, describe, expect, it } from 'vitest';
import type { Prompt } from '../../web/src/worker/protocol';
import { batchedPrompts, separated } from '../eval/batched.mjs';
import { draw, frameOf, png } from '../eval/draw.mjs';
import { faultOf } from '../eval/faults.mjs';
import type { Nodes } from '../eval/judged.mjs';
import { keptRelations } from '../eval/kept_relations.mjs';
import { blame } from '../eval/paper/blame.mjs';
import { sliderAt } from '../eval/paper/slider.mjs';
import { judge } from '../eval/predicates.mjs';
import { score } from '../eval/study/score.mjs';
import { withPicture } from '../eval/variants.mjs';
import { call, loadModule } from './module';

type Point = readonly [number, number, number];
const sides = [
  0, 1, 2, 2, 1, 3, 4, 6, 5, 5, 6, 7, 0, 4, 1, 1, 4, 5, 2, 3, 6, 6, 3, 7, 0, 2, 4, 4, 2, 6, 1, 5, 3, 3, 5, 7,
];
const box = (name: string, [x0, y0, z0]: Point, [x1, y1, z1]: Point) => ({
  name,
  points: Array.from({ length: 8 }, (_, i) => [i & 1 ? x1 : x0, i & 2 ? y1 : y0, i & 4 ? z1 : z0]),
  triangles: sides,
});
/** A top on two legs, as wide as `half` to each side, its left leg as long as `leg`. */
const table = (half = 1, leg = 1): Nodes =>
  new Map([
    ['node:0', box('top', [-half, 1, -0.5], [half, 1.1, 0.5])],
    ['node:1', box('leg_left', [0.8, 1 - leg, -0.1], [0.9, 1, 0.1])],
    ['node:2', box('leg_right', [-0.9, 0, -0.1], [-0.8, 1, 0.1])],
  ]);
const part = (id: string, node: number) => ({ id, node, label: id, virtual: false });
const shape = {
  parts: [part('top', 0), part('leg_left', 1), part('leg_right', 2)],
  relations: [
    { id: 'r1', kind: 'reflection', parts: ['leg_left', 'leg_right'], normal: [1, 0, 0] },
    { id: 'a1', kind: 'point', parts: ['top', 'leg_left'] },
    { id: 'a2', kind: 'point', parts: ['top', 'leg_right'] },
    { id: 'g1', kind: 'ground', parts: ['leg_left'] },
  ],
};

describe('predicates', () => {
  const ok = (predicate: object, now: Nodes, share?: number) => judge(predicate, table(), now, share).ok;

  it('of sizes are a difference, a size or a factor, of a part or the whole', () => {
    const wide = table(1.5);
    expect(ok({ part: 'whole', measure: 'size_x', by: 1 }, wide)).toBe(true);
    expect(ok({ part: 'whole', measure: 'size_x', to: 3 }, wide)).toBe(true);
    expect(ok({ part: 'top', measure: 'size_x', times: 1.5 }, wide)).toBe(true);
    expect(ok({ part: 'top', measure: 'size_x', times: 1.4 }, wide)).toBe(false);
    expect(ok({ part: 'whole', measure: 'size_y', by: 0 }, wide)).toBe(true);
    expect(ok({ part: 'whole', measure: 'size_y', by: 0.1 }, wide)).toBe(false);
  });

  it('of numbers of nodes take a number', () => {
    const three = new Map([...table(), ['node:3', box('leg_3', [0, 0, 0], [0.1, 1, 0.1])]]);
    expect(
      judge({ group: 'leg', by: 1 }, new Map([...table(), ['node:3', box('leg', [0, 0, 0], [1, 1, 1])]]), three).ok,
    ).toBe(false);
    expect(judge({ group: 'leg_left', by: 0 }, table(), three).ok).toBe(true);
    expect(judge({ group: 'leg', to: 1 }, table(), three).ok).toBe(true);
  });

  it('of mirror images and of what touches tell both ways', () => {
    const legs = ['leg_left', 'leg_right'];
    expect(ok({ mirror: 'x', pair: legs, holds: true }, table(2))).toBe(true);
    expect(ok({ mirror: 'x', pair: legs, holds: true }, table(1, 0.5))).toBe(false);
    expect(ok({ mirror: 'x', pair: legs, holds: false }, table(1, 0.5))).toBe(true);
    expect(ok({ touching: true, pair: ['top', 'leg_left'] }, table(1, 0.5))).toBe(true);
    expect(ok({ touching: true, pair: legs }, table())).toBe(true); // as far apart as before is no gap
    const apart = new Map([...table(), ['node:0', box('top', [-1, 1.3, -0.5], [1, 1.4, 0.5])]]);
    expect(ok({ touching: false, pair: ['top', 'leg_left'] }, apart)).toBe(true);
  });

  it('take a change of a thin part by its share of it', () => {
    const thicker = new Map([...table(), ['node:0', box('top', [-1, 1, -0.5], [1, 1.107, 0.5])]]);
    const predicate = { part: 'top', measure: 'size_y', change: 'increase' };
    expect(ok(predicate, thicker)).toBe(false);
    expect(ok(predicate, thicker, 1 / 20)).toBe(true);
    expect(ok({ ...predicate, change: 'decrease' }, thicker, 1 / 20)).toBe(false);
  });
});

describe('kept relations', () => {
  it('are all there at rest, and when the top alone gets wider', () => {
    expect(keptRelations(shape, table(), table())).toEqual({ kept: 4, of: 4, lost: [] });
    expect(keptRelations(shape, table(), table(1.3))).toEqual({ kept: 4, of: 4, lost: [] });
  });

  it('are lost where a leg ends in the air and where a joint comes apart, but for those given up', () => {
    const short = table(1, 0.5);
    expect(keptRelations(shape, table(), short).lost).toEqual(['r1', 'g1']);
    expect(keptRelations(shape, table(), short, ['r1'])).toEqual({ kept: 2, of: 3, lost: ['g1'] });
    expect(keptRelations(shape, table(), table(0.5)).lost).toEqual(['a1', 'a2']);
  });

  it('are not asked of parts that are gone', () => {
    const { of } = keptRelations(shape, table(), new Map([...table()].filter(([node]) => node !== 'node:1')));
    expect(of).toBe(1);
  });
});

describe('the slider of a pair', () => {
  const seed = [{ op: 'scale_1d', part: 'top' }];
  it('stands where the seed has moved by 0.2 half-diagonals, or at its end', async () => {
    const rest = table();
    const unit = Math.hypot(2, 1.1, 1) / 2;
    const at = async (x: number) => table(1 + x);
    expect(await sliderAt(shape, rest, seed, 1, at)).toBeCloseTo(0.2 * unit, 4);
    expect(await sliderAt(shape, rest, seed, 0.1, at)).toBe(0.1);
  });

  it('stands at 0.2 for turns and counts', async () => {
    const at = async () => table();
    expect(await sliderAt(shape, table(), [{ op: 'rotate', part: 'top' }], 0.35, at)).toBe(0.2);
    expect(await sliderAt(shape, table(), [{ op: 'change_count', relation: 't1' }], 0.1, at)).toBe(0.1);
  });
});

describe('whose fault a miss is', () => {
  const expected = { scales: ['top'], stays: ['leg_left', 'leg_right'] };
  const pair = { expected, labels: new Map<string, string>(), shape };
  const seed = [{ op: 'scale_1d', part: 'top' }];
  it('is told by what was written down', () => {
    expect(blame(pair, { seed })).toBe('search');
    expect(blame(pair, { seed: [{ op: 'rotate', part: 'top' }] })).toMatch(/^seed/);
    expect(blame(pair, { seed: [{ op: 'translate', part: 'leg_left' }] })).toMatch(/^seed/);
    expect(blame(pair, { seed, hints: { leg_left: 'rotate' } })).toMatch(/^hints/);
    expect(blame(pair, { seed, hints: { leg_left: 'keep_fixed' } })).toBe('search');
    expect(blame(pair, { seed, disabled: ['r1'] })).toMatch(/^validity/);
    expect(blame(pair, null)).toMatch(/^seed/);
    expect(blame({ ...pair, expected: undefined as never }, { seed })).toBeNull();
  });

  it('takes a face that is moved for a stretch, but not of what stays', () => {
    const face = { op: 'translate', feature: [1, 0, 0] };
    expect(blame(pair, { seed: [{ ...face, part: 'top' }] })).toBe('search');
    expect(blame(pair, { seed: [{ ...face, part: 'leg_left' }] })).toMatch(/^seed/);
  });
});

describe('what of a reading is at fault', () => {
  const wide = { op: 'scale_1d', part: 'top' };
  const high = { op: 'scale_1d', part: 'leg_left' };
  const right = { seed: [wide], hints: { leg_left: 'translate' }, disabled: ['r1'] };
  const isMet = async (edit: object) => JSON.stringify(edit) === JSON.stringify(right);

  it('is what has to be exchanged for that of one that meets the request', async () => {
    expect(await faultOf({ ...right, seed: [high] }, [right], isMet)).toBe('seed');
    expect(await faultOf({ ...right, hints: {} }, [right], isMet)).toBe('hints');
    expect(await faultOf({ ...right, disabled: [] }, [right], isMet)).toBe('validity');
    expect(await faultOf({ ...right, seed: [high], disabled: [] }, [right], isMet)).toBe('seed and validity');
  });

  it('is unknown when none meets it; one that needs less exchange counts first', async () => {
    const edit = { ...right, hints: {} };
    expect(await faultOf(edit, [], isMet)).toBeNull();
    const other = { ...right, seed: [high], disabled: [] };
    expect(await faultOf(edit, [other, right], isMet)).toBe('hints');
  });
});

describe('other ways to ask', () => {
  let prompts: Prompt[];
  let pictured: ReturnType<typeof withPicture>;
  beforeAll(async () => {
    const module = await loadModule();
    const gallery = call<{ models: { id: string }[] }>(module, 'gallery', {});
    const chair = gallery.buffers[gallery.result.models.findIndex(({ id }) => id === 'chair')] as Uint8Array;
    call(module, 'open', { name: 'chair', external: [] }, [chair]);
    const asked = { request: 'make it wider', mentioned: [] };
    ({ prompts } = call<{ prompts: Prompt[] }>(module, 'prompts', asked).result);
    const whole = prompts.filter(({ relation }) => relation === null);
    pictured = withPicture((method, parameters) => call(module, method, parameters), asked.request, whole);
  });

  it('with a picture, the prompt says which part has which number, and nothing else changes', () => {
    expect(pictured.map(({ task }) => task)).toEqual(['seed_edit', 'type_hints']);
    for (const { task, text, hash, numbered } of pictured) {
      const plain = prompts.find((prompt) => prompt.task === task);
      const [words = ''] = /\nThe picture shows .*\n/.exec(text) ?? [];
      expect(text.replace(words, '')).toBe(plain?.text);
      expect(hash).not.toBe(plain?.hash);
      expect(words).toContain(`: ${numbered.map((id, i) => `${i + 1} ${id}`).join(', ')}.`);
      for (const id of numbered) expect(plain?.text).toContain(`- ${id}`);
    }
  });

  it('one question about all relations of a kind names each of them once and asks for a list', () => {
    const batched = batchedPrompts(prompts);
    expect(batched.flatMap(({ relations }) => relations)).toEqual(
      prompts.filter(({ relation }) => relation !== null).map(({ relation }) => relation),
    );
    for (const { text, relations } of batched) {
      const [, list] = /The relations in question are\n([\s\S]*?)\n\n/.exec(text) ?? [];
      expect(list?.match(/^- (\w+):/gm)).toEqual(relations.map((id) => `- ${id}:`));
      expect(text).not.toMatch(/"keep"|this one relation|\*one\*/);
      expect(text).toContain('{"give_up": []}');
    }
  });

  it('its answer is taken apart into those that the core reads', () => {
    const block = (json: string) => `Thinking.\n\n\`\`\`json\n${json}\n\`\`\`\n`;
    const about = { relations: ['r1', 'r2'] };
    const answers = separated(about, block('{"give_up": ["r2"]}'));
    expect(answers?.get('r1')).toContain('{"keep": true}');
    expect(answers?.get('r2')).toContain('{"keep": false}');
    for (const wrong of ['{"give_up": ["r9"]}', '{"give_up": "r1"}', '{"keep": true}', 'nonsense'])
      expect(separated(about, block(wrong)), wrong).toBeNull();
    expect(separated(about, 'no block')).toBeNull();
  });
});

describe('a picture', () => {
  const side = 60;
  const colours = (pixels: Uint8Array) =>
    new Set(Array.from({ length: side * side }, (_, i) => pixels.subarray(3 * i, 3 * i + 3).join()));

  it('shows what stands in front, whatever the order of the nodes', () => {
    const near = ['node:0', box('near', [-1, -1, 1], [1, 1, 2])] as const;
    const far = ['node:1', box('far', [-0.2, -0.2, -2], [0.2, 0.2, -1])] as const;
    const frame = frameOf([new Map([near, far])]);
    const alone = draw(new Map([near]), frame, side);
    expect(colours(alone).size).toBeGreaterThan(3);
    expect(draw(new Map([near, far]), frame, side)).toEqual(draw(new Map([far, near]), frame, side));
    const middle = 3 * ((side / 2) * side + side / 2);
    const only = draw(new Map([far]), frame, side);
    expect(only.slice(middle, middle + 3)).not.toEqual(
      draw(new Map([near, far]), frame, side).slice(middle, middle + 3),
    );
  });

  it('holds all of the model in its frame', () => {
    const nodes = table();
    const pixels = draw(nodes, frameOf([nodes]), side);
    const isGround = (x: number, y: number) => pixels[3 * (y * side + x)] === 250;
    for (let i = 0; i < side; ++i)
      for (const [x, y] of [
        [i, 0],
        [i, side - 1],
        [0, i],
        [side - 1, i],
      ] as const)
        expect(isGround(x, y)).toBe(true);
  });

  it('is a PNG with the pixels that were given', () => {
    const pixels = Uint8Array.from({ length: 2 * 3 * 3 }, (_, i) => i * 7);
    const file = png(pixels, 2, 3);
    expect(file.subarray(1, 4).toString()).toBe('PNG');
    expect([file.readUInt32BE(16), file.readUInt32BE(20)]).toEqual([2, 3]);
    // The checksum of the empty IEND chunk is the same in every PNG.
    expect(file.readUInt32BE(file.length - 4)).toBe(0xae426082);
    const start = file.indexOf('IDAT') + 4;
    const rows = inflateSync(file.subarray(start, start + file.readUInt32BE(start - 8)));
    expect([...rows].filter((_, i) => i % 7 !== 0)).toEqual([...pixels]);
  });
});

describe('the answers to a study', () => {
  const key = {
    key: [
      { id: 'q1', index: 0, left: 'a' as const },
      { id: 'q2', index: 1, left: 'b' as const },
      { id: 'q3', index: 1, left: 'a' as const },
      { id: 'q4', index: 0, left: 'b' as const },
    ],
    alike: [5],
  };
  it('are put together over both orders', () => {
    const found = score(key, { q1: 'left', q4: 'right', q2: 'left', q3: 'left' });
    // Request 0: a both times. Request 1: the left side both times, which is b and then a: no preference. Request 5: alike.
    expect(found).toMatchObject({ comparisons: 3, a: 1, b: 0, ties: 2, agreement: 0.5, left: 0.75 });
  });

  it('count one that leans, leave out what is no answer', () => {
    expect(score(key, { q1: 'same', q4: 'left', q2: 'up' })).toMatchObject({
      comparisons: 2,
      b: 1,
      ties: 1,
      agreement: 0,
    });
  });
});
