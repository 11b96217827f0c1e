// The coloured part of a slider's track: from where it does nothing to where it stands.

/** Custom properties of .track, as shares of its length. */
export const trackShares = (share: (value: number) => number, zero: number, value: number) => ({
  '--zero': share(zero),
  '--low': share(Math.min(zero, value)),
  '--span': Math.abs(share(value) - share(zero)),
});
