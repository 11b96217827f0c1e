// As much XML as 3MF needs: elements, one after the other, with their attributes. No document tree, since a model has
// millions of them, and no DOMParser, which workers lack. Entities other than XML's own five do not exist: a document type
// is refused, and with it what it could define or fetch.
import { FormatError } from './model';

/** By local names, without prefixes; of two of the same local name the one without prefix. */
export type Attributes = ReadonlyMap<string, string>;

export interface Visitor {
  open(name: string, attributes: Attributes): void;
  close(name: string): void;
}

const tag = /<(\/?)([^\s/>"'<]+)((?:[^>"'<]|"[^"<]*"|'[^'<]*')*)>/y;
const attribute = /([^\s=/]+)\s*=\s*(?:"([^"]*)"|'([^']*)')/g;
const deepest = 100;

/** What is skipped between elements, by how it begins and ends. */
const asides = [
  ['<!--', '-->'],
  ['<?', '?>'],
  ['<![CDATA[', ']]>'],
] as const;

const localName = (name: string) => name.slice(name.indexOf(':') + 1);

/** @param place names the document in sentences. Throws a FormatError. */
export function visitXml(text: string, place: string, visitor: Visitor): void {
  const open: string[] = [];
  const fault = (at: number, what: string) => {
    const line = text.slice(0, at).split('\n').length;
    return new FormatError(`${place}, line ${line}: ${what}. Export it again.`);
  };
  for (let at = text.indexOf('<'); at >= 0; at = text.indexOf('<', at)) {
    const aside = asides.find(([start]) => text.startsWith(start, at));
    if (aside !== undefined) {
      const end = text.indexOf(aside[1], at + aside[0].length);
      if (end < 0) throw fault(at, 'the XML breaks off');
      at = end + aside[1].length;
      continue;
    }
    if (text.startsWith('<!', at)) throw fault(at, 'the XML has a document type, which 3MF forbids');
    tag.lastIndex = at;
    const found = tag.exec(text);
    if (found === null) throw fault(at, 'the XML is damaged or breaks off');
    const [whole, slash, name = '', rest = ''] = found;
    if (slash === '/') {
      if (open.pop() !== name) throw fault(at, `the XML is damaged at </${name.slice(0, 40)}>`);
      visitor.close(localName(name));
    } else {
      visitor.open(localName(name), attributesOf(rest));
      if (rest.endsWith('/')) visitor.close(localName(name));
      else if (open.push(name) > deepest) throw fault(at, 'the XML is nested too deeply');
    }
    at += whole.length;
  }
  if (open.length > 0) throw fault(text.length, 'the XML breaks off');
}

function attributesOf(text: string): Attributes {
  const found = new Map<string, string>();
  for (const [, name = '', double, single] of text.matchAll(attribute)) {
    const local = localName(name);
    if (local === name || !found.has(local)) found.set(local, unescaped(double ?? single ?? ''));
  }
  return found;
}

const entities: ReadonlyMap<string, string> = new Map([
  ['lt', '<'],
  ['gt', '>'],
  ['amp', '&'],
  ['quot', '"'],
  ['apos', "'"],
]);

function unescaped(text: string): string {
  if (!text.includes('&')) return text;
  return text.replace(/&(?:#x([\da-f]{1,6})|#(\d{1,7})|(\w{1,6}));/gi, (whole, hex, decimal, name) => {
    if (name !== undefined) return entities.get(name) ?? whole;
    const code = hex === undefined ? Number.parseInt(decimal, 10) : Number.parseInt(hex, 16);
    return code <= 0x10ffff ? String.fromCodePoint(code) : whole;
  });
}
