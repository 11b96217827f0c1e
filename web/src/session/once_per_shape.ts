import type { Shape } from '../program/types';

/** What is read off a shape, which never changes, once: what is selected is asked about again and again. */
export function oncePerShape<T>(read: (shape: Shape) => T): (shape: Shape) => T {
  const known = new WeakMap<Shape, { readonly value: T }>();
  return (shape) => {
    const found = known.get(shape) ?? { value: read(shape) };
    known.set(shape, found);
    return found.value;
  };
}
