// What of a reading is at fault where a request is not met: the part of it after whose exchange for that of a reading which
// meets the request, the request is met.

const pieces = { seed: [], hints: {}, disabled: [] };
const names = { seed: 'seed', hints: 'hints', disabled: 'validity' };
const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

/**
 * @param edit that does not meet the request, {seed, hints?, disabled?}. @param good edits that meet it
 * @param isMet edit → promise of a boolean
 * @returns "seed", "hints" or "validity"; several with " and " between them when only all of them together help; null when
 *   there is no good one
 */
export async function faultOf(edit, good, isMet) {
  let all = null;
  for (const right of good) {
    const other = Object.keys(pieces).filter((key) => !same(edit[key] ?? pieces[key], right[key] ?? pieces[key]));
    for (const key of other) if (await isMet({ ...edit, [key]: right[key] ?? pieces[key] })) return names[key];
    all ??= other.map((key) => names[key]).join(' and ');
  }
  return all;
}
