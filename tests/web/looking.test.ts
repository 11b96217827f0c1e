// Sides as a person sees them, put into the object's own.
import { describe, expect, it } from 'vitest';
import { type Side, sides } from '../../web/src/session/document';
import { inOwnSides, saidFrom, saysSide, sideFacing } from '../../web/src/session/looking';
import { sideWords } from '../../web/src/session/side_words';

const chair = ['seat', 'front left leg', 'front right leg', 'back left leg', 'back right leg', 'back', 'back slat 1'];
const own = (request: string, seen: Side, names = chair) => inOwnSides(request, seen, names);

describe('the side that faces whoever looks', () => {
  it.each([
    [0, 'front'],
    [0.7, 'front'],
    [0.9, 'left'],
    [Math.PI / 2, 'left'],
    [Math.PI, 'back'],
    [-Math.PI / 2, 'right'],
    [3 * Math.PI, 'back'],
    [-7.5 * Math.PI, 'left'],
  ] as const)('from %f rad is its %s', (azimuth, side) => expect(sideFacing(azimuth)).toBe(side));
});

describe('a request from where one looks', () => {
  it.each<[Side, string, string]>([
    ['front', 'lift the left leg', 'lift the right leg'],
    ['front', 'move it to the front', 'move it to the front'],
    ['back', 'lift the left leg', 'lift the left leg'],
    ['back', 'move it to the front', 'move it to the back'],
    ['left', 'move it to the left', 'move it to the front'],
    ['left', 'move it to the right', 'move it to the back'],
    ['left', 'move it forward', 'move it left'],
    ['right', 'move it to the left', 'move it to the back'],
    ['right', 'the front right leg', 'the right front leg'],
    ['front', 'Left leg longer', 'Right leg longer'],
    ['front', 'das linke Bein länger', 'das rechte Bein länger'],
    ['back', 'die vorderen Beine länger', 'die hinteren Beine länger'],
    ['left', 'nach hinten, bitte', 'nach rechts, bitte'],
  ])('seen from its %s, “%s” is “%s”', (seen, said, meant) => expect(own(said, seen)).toBe(meant));

  it.each<[string, string]>([
    ['raise the back', 'the back alone is a part'],
    ['more back slats', 'the slats have no front ones'],
    ['thicker back', 'the back alone is a part'],
    ['set it at a right angle', 'a right angle is no side'],
    ['widen the seat', 'there is no side in it'],
  ])('leaves “%s”: %s', (said) => {
    for (const seen of ['back', 'left', 'right'] as const) expect(own(said, seen)).toBe(said);
  });

  it('takes “back” for a side before what has a front one too, and behind “to the”', () => {
    expect(own('longer back legs', 'back')).toBe('longer front legs');
    expect(own('lean it to the back', 'back')).toBe('lean it to the front');
  });

  it('is a mirror image: put over twice it is what it was', () => {
    const said = 'links, rechts, vorne, hinten';
    for (const seen of sides) {
      const once = own(said, seen);
      expect(once).not.toBe(said);
      expect(own(once, seen)).toBe(said);
    }
    expect(sides.map((seen) => own(said, seen))).toEqual([
      'rechts, links, vorne, hinten',
      'vorne, hinten, links, rechts',
      'links, rechts, hinten, vorne',
      'hinten, vorne, rechts, links',
    ]);
  });

  it('says to a language model what each side is, and leaves the words alone', () => {
    const { typed, told } = saidFrom('raise the left arm', 'right', chair);
    expect(typed).toBe('raise the left arm');
    expect(told).toContain('raise the left arm\n');
    expect(told).toContain("my left is the model's own back, my right its front");
    expect(saidFrom('raise the left arm', null, chair)).toMatchObject({
      own: 'raise the left arm',
      told: 'raise the left arm',
    });
  });
});

it('every row of every language has four forms, and says a side', () => {
  for (const { rows } of sideWords)
    for (const row of rows) {
      expect(new Set(row).size).toBe(sides.length);
      for (const word of row) expect(saysSide(`so ${word}!`), word).toBe(true);
    }
  expect(saysSide('make it wider')).toBe(false);
});
