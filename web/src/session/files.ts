// From what a person drops, picks or points at to one model: a .glb, a .gltf with its files, a file of another format, a
// folder, a zip.

import { type Format, formats } from '../formats/model';
import { jsonLimits, parseJson } from '../program/json';
import type { ModelFiles } from '../scene/load';
import { listed, m, type Sentence, t } from '../texts/texts';
import { mayFetchFrom, modelHosts } from './model_hosts';

/** Running limits on what is read, against archives that are bombs. */
export const fileLimits = { bytes: 512 * 2 ** 20, entries: 10_000 } as const;

/** OpenSCAD's programs, and what it writes of one when it has run it. */
const cadKinds: readonly string[] = ['scad', 'csg'];

/** Files by path. */
export type FileSet = ReadonlyMap<string, Uint8Array>;

/** A model among files. */
export interface FoundFiles extends ModelFiles {
  /** Of a main file that has to become a GLB first, with its path among the files. */
  readonly format?: { readonly kind: Format; readonly path: string };
  /** Of a main file that is an OpenSCAD text: the variations that lie beside it, `parsel/variations` v1, if any. */
  readonly program?: { readonly variations: Uint8Array | null };
}

/** Refused, in one sentence for people. */
export class FileError extends Error {}

const extension = (path: string) => /\.([^./]+)$/.exec(path)?.[1]?.toLowerCase() ?? '';
const baseName = (path: string) => path.slice(path.lastIndexOf('/') + 1);
const isZip = (bytes: Uint8Array) => bytes[0] === 0x50 && bytes[1] === 0x4b && bytes[2] === 3 && bytes[3] === 4;

const tooMany = () => new FileError(t`That is more than 10,000 files. Open the model alone.`);

class Budget {
  #bytes = 0;
  #entries = 0;
  takeBytes(bytes: number): void {
    this.#bytes += bytes;
    if (this.#bytes > fileLimits.bytes) throw new FileError(t`That is more than 512 MB. Open a smaller model.`);
  }
  take(bytes: number): void {
    this.takeBytes(bytes);
    this.#entries++;
    if (this.#entries > fileLimits.entries) throw tooMany();
  }
}

/** Reads files that have been found, all or none: what is too large is refused before anything of it is read. */
async function readAll(files: readonly (readonly [path: string, file: File])[]): Promise<FileSet> {
  const budget = new Budget();
  for (const [, { size }] of files) budget.take(size);
  const read = new Map<string, Uint8Array>();
  for (const [path, file] of files) read.set(path, new Uint8Array(await file.arrayBuffer()));
  return read;
}

/** Files of an <input>, with the folder's paths where there are any. */
export function readPicked(files: Iterable<File>): Promise<FileSet> {
  return readAll([...files].map((file) => [file.webkitRelativePath || file.name, file] as const));
}

/** Everything that was dropped, folders walked. Call it in the handler itself: the items are gone afterwards. */
export function readDropped(transfer: DataTransfer): Promise<FileSet> {
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry()).filter((entry) => entry !== null);
  const loose = [...transfer.files];
  return entries.length === 0 ? readPicked(loose) : walk(entries);
}

async function walk(roots: readonly FileSystemEntry[]): Promise<FileSet> {
  const found: (readonly [path: string, file: File])[] = [];
  const visit = async (entry: FileSystemEntry): Promise<void> => {
    if (entry.isFile) {
      const file = await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject));
      found.push([entry.fullPath.slice(1), file]);
      if (found.length > fileLimits.entries) throw tooMany();
    } else {
      const reader = (entry as FileSystemDirectoryEntry).createReader();
      for (;;) {
        const batch = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
        if (batch.length === 0) return;
        for (const child of batch) await visit(child);
      }
    }
  };
  for (const root of roots) await visit(root);
  return readAll(found);
}

/** What is in a zip, when that is all there is. */
export async function unpacked(files: FileSet): Promise<FileSet> {
  const [only] = files;
  if (files.size !== 1 || only === undefined) return files;
  const [path, bytes] = only;
  return isZip(bytes) && extension(path) !== '3mf' ? unpack(bytes) : files; // a 3MF is a zip, and a model
}

async function unpack(bytes: Uint8Array): Promise<FileSet> {
  const { unzip } = await import('fflate');
  const budget = new Budget();
  return new Promise((resolve, reject) => {
    try {
      // fflate inflates into a buffer of the size that the directory says, so the budget holds whatever is inside.
      const filter = ({ name, originalSize }: { name: string; originalSize: number }) => {
        budget.take(originalSize);
        return !name.endsWith('/');
      };
      unzip(bytes, { filter }, (error, files) => {
        if (error) reject(new FileError(t`This zip file is damaged. Pack it again, or open the model itself.`));
        else resolve(new Map(Object.entries(files)));
      });
    } catch (error) {
      reject(error);
    }
  });
}

const isSession = (path: string) => path.endsWith('.parsel.json');

/** A session file among what was opened, or null. */
export function sessionOf(files: FileSet): Uint8Array | null {
  for (const [path, bytes] of files) if (isSession(path)) return bytes;
  return null;
}

/** glTF first: where a folder holds both, it says more. */
const kinds: readonly string[] = ['glb', 'gltf', ...formats, ...cadKinds];
const rank = (path: string) => Math.max(kinds.indexOf(extension(path)), 1);
const formatOf = (path: string): Format | undefined => formats.find((format) => format === extension(path));

/** Files that a model of another format may name. */
const companions: readonly string[] = ['mtl', 'png', 'jpg', 'jpeg', 'webp', 'bmp', 'tga', 'gif', 'tif', 'tiff', 'dds'];

/** What the file picker offers. */
export const pickable = [...kinds, 'bin', ...companions.slice(0, 5), 'zip', 'json'].map((kind) => `.${kind}`).join(',');

/** Whether there is something to open beside a session file. */
export function hasModel(files: FileSet): boolean {
  return [...files].some(([path, bytes]) => kinds.includes(extension(path)) || isZip(bytes));
}

/** Rejects with a FileError that says what to open instead. */
export async function modelOf(picked: FileSet): Promise<FoundFiles> {
  const files = await unpacked(picked);
  const candidates = [...files.keys()]
    .filter((path) => kinds.includes(extension(path)))
    .sort((a, b) => rank(a) - rank(b) || a.split('/').length - b.split('/').length || a.localeCompare(b));
  const [path] = candidates;
  const main = path === undefined ? undefined : files.get(path);
  if (path === undefined || main === undefined) throw new FileError(unreadable([...files.keys()]));
  const name = baseName(path);
  if (cadKinds.includes(extension(path))) {
    const beside = [...files].find(([other]) => other.endsWith('.variations.json'));
    return { name: plain(name), main, external: new Map(), program: { variations: beside?.[1] ?? null } };
  }
  const kind = formatOf(path);
  if (kind !== undefined) {
    const beside = [...files].filter(([other]) => kind === 'obj' && companions.includes(extension(other)));
    return { name: plain(name), main, external: new Map(beside), format: { kind, path } };
  }
  const external = extension(path) === 'gltf' ? externalFiles(path, main, files) : new Map<string, Uint8Array>();
  refuseUnreadable(name, main);
  return { name: plain(name), main, external };
}

const plain = (name: string) => name.replace(/\.[^.]+$/, '');

function unreadable(paths: readonly string[]): string {
  const kinds = [...new Set(paths.map(extension).filter(Boolean))].slice(0, 3).map((kind) => `.${kind}`);
  const what = kinds.length > 0 ? t`${kinds.join(', ')} cannot be opened here.` : t`There is no model in it.`;
  return t`${what} Open a .glb, a .gltf with its files, an .obj, .3mf, .ply, .stl, .scad or .csg, or a folder or zip that holds one.`;
}

/** The JSON of a .gltf or of a .glb's first chunk; null when it is neither. */
export function gltfJson(bytes: Uint8Array): Record<string, unknown> | null {
  try {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const binary = bytes.length >= 20 && view.getUint32(0, true) === 0x46546c67;
    const text = new TextDecoder().decode(binary ? bytes.subarray(20, 20 + view.getUint32(12, true)) : bytes);
    const read = parseJson(text, { ...jsonLimits, length: Number.POSITIVE_INFINITY }); // the file has a limit
    const json = read.ok ? read.value : null;
    return typeof json === 'object' && json !== null && !Array.isArray(json) ? (json as Record<string, unknown>) : null;
  } catch {
    return null;
  }
}

/** Extensions without which a file cannot be shown, and what to do about each. */
const unsupported: ReadonlyMap<string, Sentence> = new Map([
  ['KHR_texture_basisu', m`its textures are KTX2; export it with PNG or JPEG textures`],
]);

function refuseUnreadable(name: string, bytes: Uint8Array): void {
  const json = gltfJson(bytes);
  if (json === null) throw new FileError(t`${name} is damaged: its glTF header cannot be read. Export it again.`);
  const required = Array.isArray(json['extensionsRequired']) ? json['extensionsRequired'] : [];
  for (const extensionName of required) {
    const reason = unsupported.get(String(extensionName));
    if (reason !== undefined) throw new FileError(t`${name} needs ${String(extensionName)}: ${t(reason)}.`);
  }
}

/** The buffers and images that a .gltf names, by the names that it uses. */
function externalFiles(path: string, main: Uint8Array, files: FileSet): Map<string, Uint8Array> {
  const json = gltfJson(main);
  const folder = path.slice(0, path.lastIndexOf('/') + 1);
  const found = new Map<string, Uint8Array>();
  const missing: string[] = [];
  for (const list of [json?.['buffers'], json?.['images']]) {
    for (const item of Array.isArray(list) ? list : []) {
      const uri: unknown = (item as { uri?: unknown } | null)?.uri;
      if (typeof uri !== 'string' || uri.startsWith('data:')) continue;
      const relative = safeDecode(uri);
      const bytes = files.get(folder + relative) ?? files.get(relative) ?? files.get(baseName(relative));
      if (bytes === undefined) missing.push(baseName(relative));
      else found.set(relative, bytes);
    }
  }
  if (missing.length > 0) {
    throw new FileError(t`${baseName(path)} also needs ${missing.slice(0, 3).join(', ')}: drop the files together.`);
  }
  return found;
}

function safeDecode(uri: string): string {
  try {
    return decodeURIComponent(uri);
  } catch {
    return uri;
  }
}

/** An address in full, or null when it is none. */
export const addressOf = (address: string): string | null =>
  URL.canParse(address, location.href) ? new URL(address, location.href).href : null;

/** Fetches a model. The page's policy lets it ask its own site, this machine and the hosts of model_hosts.ts, nobody else. */
export async function readUrl(address: string, signal: AbortSignal): Promise<FileSet> {
  const full = addressOf(address);
  if (full === null) throw new FileError(t`That is no address. It should read like https://…/model.glb.`);
  const url = new URL(full);
  if (!mayFetchFrom(url, location.origin)) {
    const hosts = modelHosts.length > 0 ? ` ${t`It may from ${listed(modelHosts)}.`}` : '';
    throw new FileError(
      t`This page may not fetch from ${url.hostname}, for your safety.${hosts} Download the file and drop it here.`,
    );
  }
  const response = await fetch(url, { signal }).catch(() => null);
  if (!response?.ok)
    throw new FileError(t`${url.pathname} could not be fetched (${response?.status ?? t`no answer`}).`);
  const budget = new Budget();
  const chunks: Uint8Array[] = [];
  const reader = response.body?.getReader();
  for (let part = await reader?.read(); part?.value !== undefined; part = await reader?.read()) {
    budget.takeBytes(part.value.length);
    chunks.push(part.value);
  }
  const name = baseName(safeDecode(url.pathname)) || 'model';
  const bytes = new Uint8Array(await new Blob(chunks as BlobPart[]).arrayBuffer());
  return new Map([[named(name, bytes), bytes]]);
}

/** Addresses such as …/download?id=7 do not say what a file is; its first bytes do. */
function named(name: string, bytes: Uint8Array): string {
  if (extension(name) !== '' || isZip(bytes)) return name;
  const start = new TextDecoder('latin1').decode(bytes.subarray(0, 64)).trimStart();
  if (start.startsWith('glTF')) return `${name}.glb`;
  if (start.startsWith('{')) return `${name}.gltf`;
  if (/^ply\s/.test(start)) return `${name}.ply`;
  return /^solid\s/.test(start) ? `${name}.stl` : name;
}
