// What parts are called whose file says nothing: exporters write "default", "Mesh.003" or their own name instead.
import { shortened } from '../program/cut';
import { fileName, type Node } from './model';

/** Words that programs put where a person has given no name, with or without a number. */
const placeholder =
  /^(?:default|none|null|unnamed|untitled|no_?name|object|obj|mesh|group|solid|part|body|component|shape|geometry|polysurface|root(?:node)?|ascii|stl|model|(?:open)?scad_?model|.*\b(?:exported|generated|created) (?:from|by|with)\b.*)?[\s_.:#-]*\d*$/i;

const longest = 200; // UTF-16 units

/** Whether a name of a file says nothing about what it names. */
export const isPlaceholder = (name: string): boolean => placeholder.test(name.trim().slice(0, longest));

/** For sentences: no line breaks or other control characters, no more than is read at a glance. */
export const printable = (text: string): string => shortened(text.replace(/[\p{Cc}\u2028\u2029]+/gu, ' ').trim(), 60);

/** The name of a file in a sentence. */
export const shownFile = (path: string): string => printable(fileName(path));

/**
 * Names every node with a mesh: its own name, else that of the nearest node around it that has one, else `base`, with a
 * number where there are several of those.
 */
export function nameNodes(roots: readonly Node[], base: string): void {
  const nameless: Node[] = [];
  const visit = (node: Node, around: string) => {
    const own = shortened(node.name.replace(/[\p{Cc}\u2028\u2029]+/gu, ' ').trim(), longest);
    node.name = isPlaceholder(own) ? around : own;
    if (node.name === '' && node.mesh.length > 0) nameless.push(node);
    for (const child of node.children) visit(child, node.name);
  };
  for (const node of roots) visit(node, '');
  const [first, ...others] = nameless;
  if (first !== undefined && others.length === 0) first.name = base;
  else for (const [i, node] of nameless.entries()) node.name = `${base} ${i + 1}`;
}
