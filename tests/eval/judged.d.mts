/** What readNodes() of predicates.mjs gives: nodes by "node:<index>". */
export type Nodes = ReadonlyMap<
  string,
  { readonly name: string; readonly points: readonly number[][]; readonly triangles: readonly number[] }
>;
