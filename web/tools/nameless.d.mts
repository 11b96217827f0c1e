export const namelessIds: readonly string[];
export function withoutNames(glb: Uint8Array): Uint8Array;
