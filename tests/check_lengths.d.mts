export function lengthFaults(file: string, text: string, exempt?: readonly string[]): string[];
