export function circleFaults(texts: ReadonlyMap<string, string>, known?: Record<string, string>): string[];
