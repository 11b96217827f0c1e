export function importFaults(file: string, text: string): string[];
export function circleFaults(texts: ReadonlyMap<string, string>): string[];
