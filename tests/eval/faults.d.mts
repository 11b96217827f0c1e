/** See faults.mjs. */
export function faultOf(
  edit: object,
  good: readonly object[],
  isMet: (edit: object) => Promise<boolean>,
): Promise<string | null>;
