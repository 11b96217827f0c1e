export function blame(
  pair: {
    readonly expected?: Record<string, unknown>;
    readonly labels: ReadonlyMap<string, string>;
    readonly shape: { readonly parts: readonly object[]; readonly relations: readonly object[] };
  },
  edit: { readonly seed: readonly object[]; readonly hints?: object; readonly disabled?: readonly string[] } | null,
): string | null;
