// What a layer and its slider are called.
import type { Layer } from './types';

/** With a capital, however it was typed. */
export function titleOf({ request }: Pick<Layer, 'request'>): string {
  return request === '' ? 'Edit' : request.charAt(0).toUpperCase() + request.slice(1);
}
